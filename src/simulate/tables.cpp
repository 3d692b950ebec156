#include "simulate/tables.h"

namespace shoal {

static gpu::Texture makeTable(gpu::Context& context, const std::vector<glm::vec4>& table, int rows,
                              const char* label) {
    gpu::Texture texture(context, gpu::Format::rgba32f, stateWidth, rows, label);
    texture.upload(gpu::Traffic::Kind::parameters, 0, 0, stateWidth, rows, table.data(),
                   table.size() * sizeof(glm::vec4));
    return texture;
}

Tables::Tables(gpu::Context& context, const Plan& plan)
    : topology(makeTable(context, plan.topology, plan.topologyRows, "topology")),
      samples(makeTable(context, plan.samples, plan.sampleRows, "samples")) {}

}  // namespace shoal
