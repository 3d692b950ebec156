#include "render/group_drawer.h"

#include "gpu/gl.h"
#include "render/molecule_state.h"

namespace shoal {

GroupDrawer::GroupDrawer(gpu::Context& context, const std::string& shaderRoot, gpu::Programs& programs,
                         const GroupPlan& plan, size_t index)
    : context_(&context),
      programs_(&programs),
      shaderRoot_(shaderRoot),
      name_(plan.name),
      corners_(context, plan.name.c_str()),
      index_(index),
      count_(plan.count),
      rows_(plan.texture.firstRow, plan.texture.slabRows, plan.texture.firstRecordRow, 0),
      layout_(plan.layout()) {}

void GroupDrawer::addOrderDefines(const std::vector<std::string>& defines) {
    orderDefines_.insert(orderDefines_.end(), defines.begin(), defines.end());
}

void GroupDrawer::colorBy(const ColorScale& scale, int vertexCount) {
    scale_.emplace(scale, vertexCount);
}

const gpu::Program& GroupDrawer::beginLit(const StateView& state, const DrawInputs& inputs) {
    const gpu::Program& lit = program(lit_, litOptions_, state);
    lit.use();
    inputs.eye.origin.apply(lit);
    inputs.lighting.apply(lit, inputs.eye);
    lit.set("toClip", inputs.eye.toClip);
    if (scale_) scale_->apply(lit);
    return lit;
}

const gpu::Program& GroupDrawer::beginDepth(const StateView& state, const ShadowMap& shadow) {
    const gpu::Program& depth = program(depth_, depthOptions_, state);
    depth.use();
    shadow.origin().apply(depth);
    depth.set("toClip", shadow.toClip());
    return depth;
}

const gpu::Program& GroupDrawer::program(Variants& variants, const gpu::ProgramOptions& options,
                                         const StateView& state) const {
    const gpu::Program*& program = variants[state.textures ? 0 : 1];
    if (program != nullptr) return *program;
    gpu::ProgramOptions wanted = options;
    const std::vector<std::string> defines = stateDefines(state, layout_);
    wanted.defines.insert(wanted.defines.end(), defines.begin(), defines.end());
    if (&variants == &lit_) {
        wanted.defines.insert(wanted.defines.end(), orderDefines_.begin(), orderDefines_.end());
        if (scale_) wanted.defines.emplace_back("COLOR_BY");
    }
    program = &programs_->get(*context_, shaderRoot_, wanted);
    return *program;
}

void GroupDrawer::bind(const gpu::Program& program, const StateView& state, const GroupBuffers::Part* part,
                       int count) const {
    bindState(program, state, index_, rows_, part);
    if (stream_.batch > 1) program.set("drawnCount", count);
    corners_.bind();
    if (!stream_.indexed) glEnable(GL_PROGRAM_POINT_SIZE);
}

void GroupDrawer::submit(const gpu::Program& program, const StateView& state) const {
    const auto draw = [&](const GroupBuffers::Part* part, int count) {
        bind(program, state, part, count);
        const int instances = (count + stream_.batch - 1) / stream_.batch;
        if (stream_.indexed)
            glDrawElementsInstanced(GL_TRIANGLES, stream_.corners, GL_UNSIGNED_INT, nullptr, instances);
        else
            glDrawArraysInstanced(GL_POINTS, 0, stream_.corners, instances);
        glDisable(GL_PROGRAM_POINT_SIZE);
    };
    if (state.textures) return draw(nullptr, count_);
    for (const GroupBuffers::Part& part : (*state.buffers)[index_].parts())
        draw(&part, part.count);
}

void GroupDrawer::submitSlab(const gpu::Program& program, const StateView& state, const SlabDraws& draws,
                             int slab) const {
    bind(program, state, state.buffers ? &(*state.buffers)[index_].parts()[0] : nullptr, count_);
    draws.bind(program);
    draws.draw(slab);
    glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace shoal
