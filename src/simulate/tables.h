// Holds what every group of a plan shares and no frame changes: the topology of the molecules, the samples of
// grids, height fields and distance fields, and the tiles of noise. Layout: compile/plan.h; a texture has
// entry i of its table at (i mod 1024, i / 1024). Of a table without entries there is nothing.
#pragma once

#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace shoal {

struct Tables {
    // The fused path reads from buffers, which need no second coordinate: on a CPU rasteriser a fetch then
    // costs half as much.
    enum class Form { texture, buffer };

    gpu::Texture topology, samples;  // as textures
    gpu::Buffer topologyBuffer, sampleBuffer;
    gpu::BufferTexture sampleTexels;             // as a buffer
    std::vector<gpu::VolumeTexture> noiseTiles;  // of the plan's

    // Error: more samples than a buffer texture of the context holds.
    Tables(gpu::Context& context, const Plan& plan, Form form);

    // Binds the samples and the tiles that a program reads, which is in use.
    void bind(const gpu::Program& program, const Plan& plan) const;
    // Takes over the plan's topology of a group from its base on, which has changed in numbers alone. Of
    // buffers.
    void updateTopology(const Plan& plan, size_t group);
};

}  // namespace shoal
