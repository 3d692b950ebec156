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

Tables::Tables(gpu::Context& context, const Plan& plan, Form sampleForm)
    : topology(makeTable(context, plan.topology, plan.topologyRows, "topology")) {
    if (sampleForm == Form::texture) {
        samples = makeSamples(context, plan);
        return;
    }
    if (plan.samples.empty()) return;
    gpu::BufferTexture::checkTexels(context.info(), plan.samples.size(), "samples");
    const std::span<const glm::vec4> table(plan.samples);
    sampleBuffer = gpu::Buffer(context, gpu::Buffer::Use::storage, table, "samples");
    sampleTexels = gpu::BufferTexture(context, sampleBuffer, "samples");
}

}  // namespace shoal
