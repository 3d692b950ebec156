// Slabs of depth, in which blended groups take turns: everything of the farthest slab first, whatever its
// group. Within a group the order stays exact; of two groups, what lies in one slab may be drawn the wrong
// way round.
#pragma once

#include <string>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/draw_order.h"

namespace shoal {

class DepthSlabs {
  public:
    // Every slab is to hold about as many molecules of the group with this order.
    DepthSlabs(gpu::Context& context, const std::string& shaderRoot, int count, const DrawOrder& order);

    void update(const DrawOrder& order);  // of the group that it was made for; changes the framebuffer
    void bind(const gpu::Program& program) const;
    int count() const { return bounds_.width(); }

  private:
    gpu::Texture bounds_;  // texel s: first key of slab s, first one past it
    gpu::Framebuffer target_;
    gpu::Program program_;
    gpu::VertexArray noAttributes_;
};

}  // namespace shoal
