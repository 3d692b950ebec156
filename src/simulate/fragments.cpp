#include "simulate/fragments.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Program;
using Targets = KernelOptions::Targets;

// The 4-vectors that a frame writes of a molecule.
static size_t storedByStep(const GroupPlan& group) {
    return group.isStill() ? 0 : storedInFragments(group).size();
}

// How contact reads the layers, a texel a molecule, and changes them.
class Fragments::Touched : public ContactState {
  public:
    explicit Touched(Fragments& path) : path_(&path) {}
    bool fused() const override { return true; }
    std::vector<std::string> defines(size_t group) const override {
        std::vector<std::string> out = path_->plan_->groups[group].layout().defines(true);
        if (path_->state[group].hasConstants()) out.emplace_back("CONSTANTS");
        return out;
    }
    void bind(const Program& program, size_t group) override {
        const GroupLayers& layers = path_->state[group];
        if (program.uses("oldState")) program.texture("oldState", 0, layers.state());
        if (program.uses("oldRecords")) program.texture("oldRecords", 1, layers.records());
        if (program.uses("constants")) program.texture("constants", 2, layers.constants());
    }
    void apply(size_t group, const Gains& gains) override {
        GroupLayers& layers = path_->state[group];
        const Programs& programs = path_->programs_[group];
        for (size_t i = 0; i < programs.touched.size(); ++i) {
            const Program& program = *programs.touched[i];
            program.use();
            program.set("groupMolecules", path_->plan_->groups[group].count);
            gains(program, kernel_unit::steering + 1);
            path_->draw(program, group, layers.newState()[i], layers.count());
        }
        if (!programs.touched.empty()) layers.flip();
    }

  private:
    Fragments* path_;
};

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
        if (kernel.software && group.needs.collide)
            mostVertices_ = std::max(mostVertices_, verticesOfLane(group, kernel));
        Programs& programs = programs_.emplace_back();
        const std::vector<Targets> draws = drawsOf(storedByStep(group), targets);
        programs.kernel = std::make_unique<GroupKernel>(
            source, g, kernel, GroupKernel::Steps(draws.begin(), draws.end()), made_);
        if (query_ && !group.isStill())
            programs.watch = &programs.kernel->also(KernelOptions::Work::watch, Targets{});
        if (!state[g].hasNormals()) continue;
        for (const Targets& draw : drawsOf(group.kernel.normals.size(), targets))
            programs.normals.push_back(&programs.kernel->also(KernelOptions::Work::normals, draw));
    }
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        Programs& programs = programs_[contact.group];
        for (const Targets& draw : drawsOf(storedByStep(group), targets))
            programs.touched.push_back(&programs.kernel->also(KernelOptions::Work::touched, draw));
    }
    if (plan.contact.any()) {
        contactState_ = std::make_unique<Touched>(*this);
        contact_ = std::make_unique<TextureContact>(context, shaderRoot, plan, tables, *contactState_,
                                                    options.cache);
    }
    if (plan.school.any())
        school_ = std::make_unique<TextureSchool>(context, shaderRoot, plan, tables, options.cache);
    if (plan.hasLife())
        births_ = std::make_unique<TextureBirths>(context, shaderRoot, plan, tables, targets, options.cache);
}

void Fragments::draw(const Program& program, size_t group, const gpu::Framebuffer& target, int molecules,
                     int vertices) const {
    if (molecules == 0) return;
    const GroupLayers& layers = state[group];
    program.texture("oldState", kernel_unit::oldState, layers.state());
    program.texture("oldRecords", kernel_unit::oldRecords, layers.records());
    if (layers.hasConstants()) program.texture("constants", kernel_unit::constants, layers.constants());
    programs_[group].kernel->bindTables(program);
    target.bind(0, 0, std::min(stateWidth, molecules), (molecules + stateWidth - 1) / stateWidth);
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, vertices);
}

void Fragments::run(const Frame& frame, gpu::PassTimers& timers) {
    const auto timer = timers.time("fused");
    gpu::drawPlainly();
    for (size_t g = 0; g < state.size(); ++g) {
        GroupKernel& kernel = *programs_[g].kernel;
        const bool lives = births_ && births_->has(g);
        kernel.update(frame);
        for (size_t i = 0; i < kernel.steps(); ++i) {
            const Program& program = kernel.useStep(frame, i);
            if (plan_->groups[g].needs.steers) {
                program.texture("steering", kernel_unit::steering, state[g].steering());
                program.set("givenSteeringEnd", float(steeringEnd_ - frame.time));
            }
            if (contact_) contact_->bindLoads(program, kernel_unit::loads, g);
            const int vertices = lives ? births_->bindStep(program, g) : 3;
            draw(program, g, state[g].newState()[i], lives ? births_->reach(g) : state[g].count(), vertices);
        }
        if (kernel.steps() > 0) state[g].flip();
    }
}

void Fragments::step(const Frame& frame, gpu::PassTimers& timers) {
    steeringEnd_ = frame.end;
    if (school_) school_->step(frame, state, timers);
    pieces_ = piecesOf(*plan_, mostVertices_, frame.parameters.substeps, gpu::mostSoftwareTurns);
    for (int i = 0; i < pieces_; ++i) {
        const Frame piece = pieceOf(frame, i, pieces_);
        run(piece, timers);
        if (births_) births_->step(piece, state, timers);
        if (contact_) contact_->step(piece, *contactState_, timers);
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
            draw(*programs_[g].normals[i], g, state[g].newNormals()[i], state[g].count());
        }
}

// Nothing is drawn: the target is the side that is not read, with its colours masked.
void Fragments::watch(gpu::PassTimers& timers) {
    const auto timer = timers.time("watch");
    const RunawayQuery::Asking asking(*query_);
    for (size_t g = 0; g < state.size(); ++g) {
        if (programs_[g].watch == nullptr) continue;
        programs_[g].watch->use();
        draw(*programs_[g].watch, g, state[g].newState().front(), state[g].count());
    }
}

std::optional<std::vector<GroupState>> Fragments::readBefore() const {
    if (births_) return {};                  // newborns have taken places since
    if (school_) return {};                  // the muscles' clocks have moved on
    if (contact_ || pieces_ > 1) return {};  // the side before is that of a step within the frame
    std::vector<GroupState> out;
    for (size_t g = 0; g < state.size(); ++g)
        out.push_back(plan_->groups[g].isStill() ? state[g].read(plan_->groups[g])
                                                 : state[g].readBefore(plan_->groups[g]));
    return out;
}

void Fragments::write(size_t group, const GroupState& groupState, double time) {
    state[group].write(plan_->groups[group], groupState);
    if (plan_->groups[group].needs.life) births_->write(group, groupState, time);
}

GroupState Fragments::read(size_t group) const {
    GroupState out = state[group].read(plan_->groups[group]);
    if (plan_->groups[group].needs.life) births_->read(group, out);
    return out;
}

bool Fragments::changeLife(size_t group, const Lifecycle& life) {
    return plan_->groups[group].needs.life && births_->change(group, life);
}

void Fragments::disarm() {
    if (query_) query_->disarm();
}

}  // namespace shoal
