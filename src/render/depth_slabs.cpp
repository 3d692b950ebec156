#include "render/depth_slabs.h"

#include "gpu/gl.h"
#include "render/lighting.h"

namespace shoal {

DepthSlabs::DepthSlabs(gpu::Context& context, const std::string& shaderRoot, int count,
                       const DrawOrder& order)
    : bounds_(context, gpu::Format::rg32ui, count, 1, "depth slabs"),
      target_(context, {&bounds_}, nullptr, "depth slabs"),
      program_(context, shaderRoot,
               {"passes/fullscreen.vert", "render/slabs.frag", order.defines(), {}, "depth slabs"}),
      noAttributes_(context, "depth slabs") {}

void DepthSlabs::update(const DrawOrder& order) {
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST})
        glDisable(state);
    target_.bind();
    program_.use();
    order.bind(program_);
    program_.set("moleculeCount", order.count());
    program_.set("slabCount", count());
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DepthSlabs::bind(const gpu::Program& program) const {
    program.texture("slabs", unit::slabs, bounds_);
}

}  // namespace shoal
