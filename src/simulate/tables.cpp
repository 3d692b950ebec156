#include "simulate/tables.h"

#include <cmath>
#include <span>

namespace shoal {

static gpu::Texture makeTable(gpu::Context& context, const std::vector<glm::vec4>& table, int rows,
                              const char* label) {
    gpu::Texture texture(context, gpu::Format::rgba32f, stateWidth, rows, label);
    texture.upload(gpu::Traffic::Kind::parameters, 0, 0, stateWidth, rows, table.data(),
                   table.size() * sizeof(glm::vec4));
    return texture;
}

// A distance field's samples grow with the cube of its resolution.
static gpu::Texture makeSamples(gpu::Context& context, const Plan& plan) {
    const int largest = context.info().maxTextureSize;
    if (plan.sampleRows > largest)
        throw Error(concat("grids, height fields and distance fields have ", plan.samples.size(),
                           " samples, and a table of this context holds ", size_t(largest) * stateWidth,
                           ": distance fields alone would fit at ",
                           std::floor(95 * std::cbrt(double(largest) / plan.sampleRows)),
                           " % of their resolutions"));
    return makeTable(context, plan.samples, plan.sampleRows, "samples");
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
        topology = makeTable(context, plan.topology, plan.topologyRows, "topology");
        samples = makeSamples(context, plan);
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
