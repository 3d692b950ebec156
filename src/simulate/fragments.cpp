#include "simulate/fragments.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Program;
using Targets = KernelOptions::Targets;

static std::vector<Targets> drawsOf(size_t values, int targets) {
    std::vector<Targets> out;
    for (int first = 0; first < int(values); first += targets)
        out.push_back({first, std::min(targets, int(values) - first)});
    return out;
}

Fragments::Fragments(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                     const Tables& tables, const SimulationOptions& options)
    : plan_(&plan), noAttributes_(context, "fused step") {
    const KernelSource source{&context, shaderRoot, &plan, &tables, options.cache};
    const int targets = context.info().maxColorAttachments;
    if (options.watchdog) query_ = std::make_unique<RunawayQuery>(context.traffic());
    KernelOptions kernel;
    kernel.software = context.info().software;
    kernel.groupVote = context.info().groupVote;
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        state.emplace_back(context, group, options.drawn, targets);
        Programs& programs = programs_.emplace_back();
        programs.kernel = std::make_unique<GroupKernel>(
            source, g, kernel, drawsOf(storedInFragments(group).size(), targets), made_);
        if (query_) programs.watch = &programs.kernel->also(KernelOptions::Work::watch, Targets{});
        if (!state[g].hasNormals()) continue;
        for (const Targets& draw : drawsOf(group.kernel.normals.size(), targets))
            programs.normals.push_back(&programs.kernel->also(KernelOptions::Work::normals, draw));
    }
    if (plan.school.any())
        school_ = std::make_unique<TextureSchool>(context, shaderRoot, plan, tables, options.cache);
}

void Fragments::draw(const Program& program, size_t group, const gpu::Framebuffer& target) const {
    const GroupLayers& layers = state[group];
    program.texture("oldState", kernel_unit::oldState, layers.state());
    program.texture("oldRecords", kernel_unit::oldRecords, layers.records());
    if (layers.hasConstants()) program.texture("constants", kernel_unit::constants, layers.constants());
    programs_[group].kernel->bindTables(program);
    target.bind(0, 0, std::min(stateWidth, plan_->groups[group].count), target.height());
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Fragments::step(const Frame& frame, gpu::PassTimers& timers) {
    if (school_) school_->step(frame, state, timers);
    {
        const auto timer = timers.time("fused");
        gpu::drawPlainly();
        for (size_t g = 0; g < state.size(); ++g) {
            GroupKernel& kernel = *programs_[g].kernel;
            kernel.update(frame);
            for (size_t i = 0; i < kernel.steps(); ++i) {
                const Program& program = kernel.useStep(frame, i);
                if (plan_->groups[g].needs.steers) {
                    program.texture("steering", kernel_unit::steering, state[g].steering());
                    program.set("givenSteeringEnd", float(frame.end - frame.time));
                }
                draw(program, g, state[g].newState()[i]);
            }
            state[g].flip();
        }
    }
    computeNormals(timers);
    if (query_) watch(timers);
}

void Fragments::computeNormals(gpu::PassTimers& timers) {
    const auto timer = timers.time("normals");
    gpu::drawPlainly();
    for (size_t g = 0; g < state.size(); ++g)
        for (size_t i = 0; i < programs_[g].normals.size(); ++i) {
            programs_[g].normals[i]->use();
            draw(*programs_[g].normals[i], g, state[g].newNormals()[i]);
        }
}

// Nothing is drawn: the target is the side that is not read, with its colours masked.
void Fragments::watch(gpu::PassTimers& timers) {
    const auto timer = timers.time("watch");
    const RunawayQuery::Asking asking(*query_);
    for (size_t g = 0; g < state.size(); ++g) {
        programs_[g].watch->use();
        draw(*programs_[g].watch, g, state[g].newState().front());
    }
}

std::optional<std::vector<GroupState>> Fragments::readBefore() const {
    if (school_) return {};  // the muscles' clocks have moved on
    std::vector<GroupState> out;
    for (size_t g = 0; g < state.size(); ++g)
        out.push_back(state[g].readBefore(plan_->groups[g]));
    return out;
}

void Fragments::disarm() {
    if (query_) query_->disarm();
}

}  // namespace shoal
