#include "render/group_drawer.h"

#include "gpu/gl.h"
#include "gpu/shader_source.h"

namespace shoal {

GroupDrawer::GroupDrawer(gpu::Context& context, gpu::Programs& programs, const GroupPlan& plan, size_t index)
    : context_(&context),
      programs_(&programs),
      name_(plan.name),
      corners_(context, plan.name.c_str()),
      reader_(plan, index),
      count_(plan.count),
      vertexCount_(plan.vertexCount) {}

void GroupDrawer::addOrderDefines(const std::vector<std::string>& defines) {
    orderDefines_.insert(orderDefines_.end(), defines.begin(), defines.end());
}

void GroupDrawer::dropOrder() {
    orderDefines_.clear();
    lit_ = {};
}

const gpu::Program& GroupDrawer::beginLit(const StateView& state, const DrawInputs& inputs) {
    const gpu::Program& lit = program(lit_, litOptions_, state);
    lit.use();
    inputs.eye.origin.apply(lit);
    inputs.lighting.apply(lit, inputs.eye);
    lit.set("toClip", inputs.eye.toClip);
    if (scale_) setScale(lit);
    return lit;
}

// As shaders/render/color_scale.glsl takes it.
void GroupDrawer::setScale(const gpu::Program& program) const {
    std::array<glm::vec4, mostScaleColors> colors{};
    for (size_t i = 0; i < scale_->colors.size(); ++i)
        colors[i] = glm::vec4(glm::vec3(scale_->colors[i]), 1);
    program.set("scaleColors", std::span<const glm::vec4>(colors));
    program.set("scaleLast", int(scale_->colors.size()) - 1);
    program.set("scaleSpan", glm::vec2(float(scale_->from), float(1 / (scale_->to - scale_->from))));
    program.set("scaleVertices", vertexCount_);
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
    const gpu::Program*& program = variants[state.form()];
    if (program != nullptr) return *program;
    gpu::ProgramOptions wanted = options;
    const std::vector<std::string> defines = reader_.defines(state);
    wanted.defines.insert(wanted.defines.end(), defines.begin(), defines.end());
    const bool lit = &variants == &lit_;
    wanted.defines.push_back(gpu::constant("COLOR_BY", lit && scale_));
    if (lit) wanted.defines.insert(wanted.defines.end(), orderDefines_.begin(), orderDefines_.end());
    program = &programs_->get(*context_, wanted);
    return *program;
}

void GroupDrawer::bind(const gpu::Program& program, const StateView& state, const GroupBuffers::Part* part,
                       int count) const {
    reader_.bind(program, state, part);
    if (streams_[0].batch > 1) program.set("drawnCount", count);
    corners_.bind();
    if (!streams_[0].indexed) glEnable(GL_PROGRAM_POINT_SIZE);
}

void GroupDrawer::submit(const gpu::Program& program, const StateView& state, size_t level) const {
    const DrawStream& stream = streams_[level];
    const auto draw = [&](const GroupBuffers::Part* part, int count) {
        bind(program, state, part, count);
        const int instances = (count + stream.batch - 1) / stream.batch;
        // OpenGL's way to say an offset
        const auto* offset = reinterpret_cast<const void*>(size_t(stream.first) * sizeof(uint32_t));
        gpu::beginPass();
        if (stream.indexed)
            glDrawElementsInstanced(GL_TRIANGLES, stream.corners, GL_UNSIGNED_INT, offset, instances);
        else
            glDrawArraysInstanced(GL_POINTS, 0, stream.corners, instances);
        glDisable(GL_PROGRAM_POINT_SIZE);
    };
    if (!state.buffers) return draw(nullptr, count_);
    for (const GroupBuffers::Part& part : (*state.buffers)[index()].parts())
        draw(&part, part.count);
}

void GroupDrawer::submitSlab(const gpu::Program& program, const StateView& state, const SlabDraws& draws,
                             int slab) const {
    bind(program, state, state.buffers ? &(*state.buffers)[index()].parts()[0] : nullptr, count_);
    draws.bind(program);
    draws.draw(slab);
    glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace shoal
