// One indirect draw a slab of depth, of those molecules of a sorted group that lie in it: found on the GPU
// (OpenGL 4.3), so that no vertex of another slab is touched.
#pragma once

#include <string>

#include "gpu/buffer.h"
#include "gpu/buffer_texture.h"
#include "gpu/program.h"
#include "render/depth_slabs.h"

namespace shoal {

// The contents of one instance of a draw call.
struct DrawStream {
    int corners = 1;       // indices, or vertices where there are none
    bool indexed = false;  // triangles; else points
    int batch = 1;         // molecules
};

class SlabDraws {
  public:
    SlabDraws(gpu::Context& context, const std::string& shaderRoot, int slabs, const DrawOrder& order,
              const DrawStream& stream);

    void update(const DrawOrder& order, const DepthSlabs& slabs);
    void bind(const gpu::Program& program) const;  // shaders/render/drawn.glsl, SLAB_DRAWS
    void draw(int slab) const;                     // the vertex array is bound

  private:
    int slabs_;
    DrawStream stream_;
    gpu::Program program_;
    gpu::Buffer draws_;  // shaders/render/slab_draws.comp
    gpu::BufferTexture drawTexels_;
};

}  // namespace shoal
