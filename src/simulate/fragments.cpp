#include "simulate/fragments.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Program;

// How contact reads the layers, a texel a molecule, and changes them.
class Fragments::Touched : public ContactState {
  public:
    explicit Touched(Fragments& path) : path_(&path) {}
    Form form() const override { return Form::textures; }
    std::vector<std::string> defines(size_t group) const override {
        std::vector<std::string> out = path_->plan_->groups[group].layout().defines(true);
        if (path_->state[group].hasConstants()) out.emplace_back("CONSTANTS");
        return out;
    }
    std::vector<Part> parts(size_t group) const override { return {{0, path_->plan_->groups[group].count}}; }
    void bind(const Program& program, size_t group, size_t) override {
        const GroupLayers& layers = path_->state[group];
        if (program.uses("oldState")) program.texture("oldState", layers.state());
        if (program.uses("oldRecords")) program.texture("oldRecords", layers.records());
        if (program.uses("constants")) program.texture("constants", layers.constants());
    }
    void apply(size_t group, const Gains& gains) override {
        GroupLayers& layers = path_->state[group];
        if (path_->programs_[group].touched == nullptr) return;
        const Program& program = *path_->programs_[group].touched;
        program.use();
        program.set("groupMolecules", path_->plan_->groups[group].count);
        gains(program);
        path_->draw(program, group, layers.newState(), layers.count());
        layers.flip();
    }

  private:
    Fragments* path_;
};

Fragments::Fragments(gpu::Context& context, const Plan& plan, const Tables& tables,
                     const SimulationOptions& options)
    : plan_(&plan) {
    const KernelSource source{&context, &plan, &tables};
    const int targets = context.info().maxColorAttachments;
    if (options.watchdog) query_ = std::make_unique<RunawayQuery>(context.traffic());
    KernelOptions kernel;
    kernel.targets = targets;
    kernel.software = context.info().software;
    kernel.groupVote = context.info().groupVote;
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        state.emplace_back(context, group, options.drawn, targets);
        if (kernel.software && group.needs.collide)
            mostVertices_ = std::max(mostVertices_, verticesOfLane(group, kernel));
        Programs& programs = programs_.emplace_back();
        programs.kernel = std::make_unique<GroupKernel>(source, g, kernel, !group.isStill(), made_);
        const auto also = [&](bool need, KernelOptions::Work work) {
            return need ? &programs.kernel->also(work) : nullptr;
        };
        programs.watch = also(query_ && !group.isStill(), KernelOptions::Work::watch);
        programs.normals = also(state[g].hasNormals(), KernelOptions::Work::normals);
        programs.touched = also(plan.contact.find(g) && !group.isStill(), KernelOptions::Work::touched);
    }
    if (plan.contact.any()) {
        contactState_ = std::make_unique<Touched>(*this);
        contact_ = std::make_unique<Contact>(context, plan, tables, *contactState_);
    }
    if (plan.school.any()) school_ = std::make_unique<TextureSchool>(context, plan, tables);
    if (plan.hasLife()) births_ = std::make_unique<TextureBirths>(context, plan, tables, state);
}

void Fragments::draw(const Program& program, size_t group, std::span<const LayerDraw> draws, int molecules,
                     int vertices) const {
    if (molecules == 0) return;
    const GroupLayers& layers = state[group];
    program.texture("oldState", layers.state());
    program.texture("oldRecords", layers.records());
    if (layers.hasConstants()) program.texture("constants", layers.constants());
    programs_[group].kernel->bindTables(program);
    for (const LayerDraw& draw : draws) {
        if (program.uses("firstStored")) program.set("firstStored", draw.first);
        draw.target.bind(0, 0, std::min(stateWidth, molecules), (molecules + stateWidth - 1) / stateWidth);
        gpu::drawVertices(vertices);
    }
}

void Fragments::run(const Frame& frame, gpu::PassTimers& timers) {
    const auto timer = timers.time("fused");
    gpu::drawPlainly();
    for (size_t g = 0; g < state.size(); ++g) {
        GroupKernel& kernel = *programs_[g].kernel;
        const bool lives = births_ && births_->has(g);
        if (!kernel.moves()) continue;
        kernel.update(frame);
        const Program& program = kernel.useStep(frame);
        if (plan_->groups[g].needs.steers) {
            program.texture("steering", state[g].steering());
            program.set("givenSteeringEnd", float(steeringEnd_ - frame.time));
        }
        if (contact_) contact_->bindLoads(program, g);
        const int vertices = lives ? births_->bindStep(program, g) : 3;
        draw(program, g, state[g].newState(), lives ? births_->reach(g) : state[g].count(), vertices);
        state[g].flip();
    }
}

void Fragments::step(const Frame& frame, gpu::PassTimers& timers) {
    steeringEnd_ = frame.end;
    if (school_) school_->step(frame, state, timers);
    pieces_ = piecesOf(*plan_, mostVertices_, frame.parameters.substeps, gpu::mostSoftwareTurns);
    for (int i = 0; i < pieces_; ++i) {
        const Frame piece = pieceOf(frame, i, pieces_);
        run(piece, timers);
        if (births_) births_->step(piece, timers);
        if (contact_) contact_->step(piece, timers);
    }
    computeNormals(timers);
    if (query_) watch(timers);
}

void Fragments::computeNormals(gpu::PassTimers& timers) {
    const auto timer = timers.time("normals");
    gpu::drawPlainly();
    for (size_t g = 0; g < state.size(); ++g) {
        if (programs_[g].normals == nullptr) continue;
        programs_[g].normals->use();
        draw(*programs_[g].normals, g, state[g].newNormals(), state[g].count());
    }
}

// Nothing is drawn: the target is the side that is not read, with its colours masked.
void Fragments::watch(gpu::PassTimers& timers) {
    const auto timer = timers.time("watch");
    const RunawayQuery::Asking asking(*query_);
    for (size_t g = 0; g < state.size(); ++g) {
        if (programs_[g].watch == nullptr) continue;
        programs_[g].watch->use();
        draw(*programs_[g].watch, g, std::span(state[g].newState()).first(1), state[g].count());
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
