// One indirect draw a slab of depth, of those molecules of a sorted group that lie in it: found on the GPU
// (OpenGL 4.3), so that no vertex of another slab is touched.
#pragma once

#include <string>

#include "gpu/buffer.h"
#include "gpu/buffer_texture.h"
#include "gpu/program.h"
#include "render/depth_slabs.h"

namespace shoal {

class SlabDraws {
  public:
    // `corners` of a molecule: its indices, or its vertices where it has no triangles (`indexed` false).
    SlabDraws(gpu::Context& context, const std::string& shaderRoot, int slabs, const DrawOrder& order,
              int corners, bool indexed);

    void update(const DrawOrder& order, const DepthSlabs& slabs);
    void bind(const gpu::Program& program) const;  // shaders/render/drawn.glsl, SLAB_DRAWS
    void draw(int slab) const;                     // the vertex array is bound

  private:
    int slabs_, corners_;
    bool indexed_;
    gpu::Program program_;
    gpu::Buffer draws_;  // shaders/render/slab_draws.comp
    gpu::BufferTexture drawTexels_;
};

}  // namespace shoal
