// Holds what every group of a plan shares and no frame changes: the topology of the molecules, and the
// samples of grids, height fields and distance fields. Layout: compile/plan.h.
#pragma once

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/texture.h"

namespace shoal {

struct Tables {
    // The fused path reads from buffers, which need no second coordinate: on a CPU rasteriser a fetch then
    // costs half as much.
    enum class Form { texture, buffer };

    gpu::Texture topology, samples;  // as textures
    gpu::Buffer topologyBuffer, sampleBuffer;
    gpu::BufferTexture sampleTexels;  // as a buffer; null: there are none

    // Error: more samples than the context holds.
    Tables(gpu::Context& context, const Plan& plan, Form form);
    // Takes over the plan's topology of a group from its base on, which has changed in numbers alone. Of
    // buffers.
    void updateTopology(const Plan& plan, size_t group);
};

}  // namespace shoal
