#include "simulate/tables.h"

#include <cmath>
#include <span>

namespace shoal {

// Makes a texture with the table in rows, of which the last is seldom full; none where the table is empty.
static gpu::Texture makeTable(gpu::Context& context, const std::vector<glm::vec4>& table, const char* label) {
    if (table.empty()) return {};
    gpu::Texture texture(context, gpu::Format::rgba32f, stateWidth, stateRows(table.size()), label);
    const auto upload = [&](size_t row, size_t width, size_t rows) {
        if (width * rows > 0)
            texture.upload(gpu::Traffic::Kind::parameters, 0, int(row), int(width), int(rows),
                           &table[row * stateWidth], width * rows * sizeof(glm::vec4));
    };
    const size_t full = table.size() / stateWidth;
    upload(0, stateWidth, full);
    upload(full, table.size() % stateWidth, 1);
    return texture;
}

// A component of 10 bits is 512 + its number of units.
static gpu::VolumeTexture makeTile(gpu::Context& context, const NoiseTile& tile) {
    const std::vector<float>& values = valuesOf(tile);
    if (tile.channels() == 1)
        return {context, gpu::Format::r32f, tile.texels, std::as_bytes(std::span(values)), tile.sampler()};
    std::vector<uint32_t> words(tile.count());
    for (size_t i = 0; i < values.size(); ++i)
        words[i / 3] |= uint32_t(512 + std::lround(values[i] * 511 / tile.range)) << (10 * (i % 3));
    return {context, gpu::Format::rgb10a2, tile.texels, std::as_bytes(std::span(words)), tile.sampler()};
}

Tables::Tables(gpu::Context& context, const Plan& plan, Form form) {
    for (const NoiseTile& tile : plan.fields.noiseTiles)
        noiseTiles.push_back(makeTile(context, tile));
    if (form == Form::texture) {
        topology = makeTable(context, plan.topology, "topology");
        samples = makeTable(context, plan.samples, "samples");
        return;
    }
    const std::span<const glm::vec4> entries(plan.topology);
    topologyBuffer = gpu::Buffer(context, gpu::Buffer::Use::storage, entries, "topology");
    if (plan.samples.empty()) return;
    gpu::BufferTexture::checkTexels(context.info(), plan.samples.size(), "samples");
    const std::span<const glm::vec4> table(plan.samples);
    sampleBuffer = gpu::Buffer(context, gpu::Buffer::Use::storage, table, "samples");
    sampleTexels = gpu::BufferTexture(context, sampleBuffer, "samples");
}

void Tables::bind(const gpu::Program& program, const Plan& plan) const {
    if (sampleTexels && program.uses("samples")) program.texture("samples", sampleTexels);
    if (samples && program.uses("samples")) program.texture("samples", samples);
    for (size_t i = 0; i < noiseTiles.size(); ++i)
        if (program.uses(plan.fields.noiseTiles[i].sampler()))
            program.texture(plan.fields.noiseTiles[i].sampler(), noiseTiles[i]);
}

void Tables::updateTopology(const Plan& plan, size_t group) {
    const auto first = size_t(plan.groups[group].topologyBase);
    const size_t end =
        group + 1 < plan.groups.size() ? size_t(plan.groups[group + 1].topologyBase) : plan.topology.size();
    topologyBuffer.update(gpu::Traffic::Kind::parameters, first * sizeof(glm::vec4),
                          plan.topology.data() + first, (end - first) * sizeof(glm::vec4));
}

}  // namespace shoal
