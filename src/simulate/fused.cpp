#include "simulate/fused.h"

#include "gpu/buffer.h"

namespace shoal {

using gpu::Program;

PathLimits limitsOf(const gpu::ContextInfo& info) {
    PathLimits out;
    out.version = concat(info.major, ".", info.minor);
    out.compute = info.computeShaders;
    out.targets = info.maxColorAttachments;
    out.maxTextureLayers = info.maxTextureLayers;
    out.software = info.software;
    out.maxTextureSize = info.maxTextureSize;
    out.maxSharedBytes = info.maxSharedBytes;
    out.maxUniformComponents =
        out.compute ? info.maxComputeUniformComponents : info.maxFragmentUniformComponents;
    out.maxUniformBlockBytes = info.maxUniformBlockBytes;
    return out;
}

// How contact reads the buffers, and changes them.
class Fused::Touched : public ContactState {
  public:
    explicit Touched(Fused& path) : path_(&path) {}
    Form form() const override { return Form::buffers; }
    std::vector<std::string> defines(size_t group) const override {
        std::vector<std::string> out = path_->plan_->groups[group].layout().defines();
        if (path_->state[group].hasConstants()) out.emplace_back("CONSTANTS");
        return out;
    }
    std::vector<Part> parts(size_t group) const override {
        std::vector<Part> out;
        for (const GroupBuffers::Part& part : path_->state[group].parts())
            out.push_back({part.first, part.count});
        return out;
    }
    void bind(const Program& program, size_t group, size_t index) override {
        const GroupBuffers& buffers = path_->state[group];
        const GroupBuffers::Part& part = buffers.parts()[index];
        if (program.uses("oldState")) program.texture("oldState", buffers.oldState(part));
        if (program.uses("oldRecords")) program.texture("oldRecords", part.record);
        if (program.uses("constants")) program.texture("constants", part.constant);
        if (program.declares("State")) store(program, "State", buffers.currentState(part));
    }

  private:
    Fused* path_;
};

Fused::Fused(gpu::Context& context, const Plan& plan, const Tables& tables, const SimulationOptions& options)
    : plan_(&plan), drawn_(options.drawn) {
    const gpu::ContextInfo& info = context.info();
    const KernelSource source{&context, &plan, &tables};
    // with contact, births and schools other passes change the state as well
    const bool ahead = options.watchdog && options.asOnGpu.value_or(!info.software) && info.atLeast(4, 4) &&
                       !plan.contact.any() && !plan.hasLife() && !plan.school.any();
    using Reading = RunawayWord::Reading;
    if (options.watchdog)
        alarm_.emplace(context, !ahead                        ? Reading::waits
                                : options.asOnGpu.has_value() ? Reading::late
                                                              : Reading::ahead);
    std::vector<int> together;
    const auto atMost = [&](size_t most) {
        return options.largestPart > 0 ? std::min(most, options.largestPart) : most;
    };
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        KernelOptions kernel;
        kernel.lanes = chooseLanes(plan, group, options.lanes, limitsOf(info));
        kernel.sharedBytes = info.maxSharedBytes;
        // contact still moves what a dispatch leaves, and newborns come after it
        kernel.normals = options.drawn && !plan.contact.any() && !group.needs.life;
        kernel.groupVote = info.groupVote;
        kernel.software = info.software;
        kernel.watch = options.watchdog;
        kernel.ahead = ahead;
        if (info.software && group.needs.collide)
            mostVertices_ = std::max(mostVertices_, verticesOfLane(group, kernel));
        together.push_back(workgroupMolecules(group, kernel));
        state.emplace_back(context, group, options.drawn, options.inPlace,
                           atMost(size_t(info.maxWorkGroupsX) * size_t(together.back())));
        kernels_.push_back(std::make_unique<GroupKernel>(source, g, kernel, true, programs_));
        normals_.push_back(options.drawn && group.needs.normals
                               ? &kernels_.back()->also(KernelOptions::Work::normals)
                               : nullptr);
    }
    if (plan.hasLife()) births_ = std::make_unique<BufferBirths>(context, plan, tables, state, together);
    if (plan.contact.any()) {
        contactState_ = std::make_unique<Touched>(*this);
        contact_ = std::make_unique<Contact>(context, plan, tables, *contactState_, options.asOnGpu);
    }
    if (plan.school.any()) school_ = std::make_unique<BufferSchool>(context, plan, tables);
}

void Fused::dispatch(const Program& program, size_t index, const GroupBuffers::Part& part,
                     KernelOptions::Work work) const {
    const GroupPlan& group = plan_->groups[index];
    const GroupBuffers& buffers = state[index];
    const KernelOptions& options = kernels_[index]->options();
    program.texture("oldState", buffers.oldState(part));
    program.texture("oldRecords", part.record);
    if (buffers.hasConstants()) program.texture("constants", part.constant);
    kernels_[index]->bindTables(program);
    const bool steps = work == KernelOptions::Work::frame;
    if (contact_ && steps) contact_->bindLoads(program, index, part.first);
    if (group.needs.steers && steps) program.texture("steering", part.steering);
    store(program, "NewState", buffers.newState(part));
    if (group.needs.records) store(program, "NewRecords", buffers.records(part));
    if (buffers.hasNormals() && (options.normals || !steps))
        store(program, "NewNormals", buffers.normals(part));
    const int together = workgroupMolecules(group, options);
    if (births_ && births_->has(index) && steps) return births_->dispatchStep(program, index, part);
    program.dispatch((part.count + together - 1) / together);
}

void Fused::step(const Frame& frame, gpu::PassTimers& timers) {
    steeringEnd_ = frame.end;
    if (school_) school_->step(frame, state, timers);
    pieces_ = piecesOf(*plan_, mostVertices_, frame.parameters.substeps, gpu::mostSoftwareTurns);
    for (int i = 0; i < pieces_; ++i) {
        const Frame piece = pieceOf(frame, i, pieces_);
        if (contact_) contact_->begin(piece);
        run(piece, timers);
        if (births_) births_->step(piece, timers);
        if (contact_) contact_->step(piece, timers);
    }
    if (alarm_) alarm_->endFrame(frame.number);
    if (contact_ || births_) computeNormals(timers);
}

// The kernels of these frames have changed nothing.
void Fused::goBack(int frames) {
    if (frames == 0) return;
    alarm_->goBack(frames);
    for (GroupBuffers& group : state)
        if (frames % 2 == 1) group.flip();
}

void Fused::run(const Frame& frame, gpu::PassTimers& timers) {
    const auto timer = timers.time("fused");
    gpu::barrier(
        {gpu::Barrier::textureFetch, gpu::Barrier::storage});  // a picture may still read what is written
    for (size_t g = 0; g < state.size(); ++g) {
        kernels_[g]->update(frame);
        const Program& program = kernels_[g]->useStep(frame);
        if (plan_->groups[g].needs.steers) program.set("givenSteeringEnd", float(steeringEnd_ - frame.time));
        if (alarm_) alarm_->bind(program);
        for (const GroupBuffers::Part& part : state[g].parts())
            dispatch(program, g, part, KernelOptions::Work::frame);
        state[g].flip();
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage, gpu::Barrier::bufferUpdate});
}

void Fused::write(size_t group, const GroupState& groupState, double time) {
    state[group].write(plan_->groups[group], groupState);
    if (plan_->groups[group].needs.life) births_->write(group, groupState, time);
}

GroupState Fused::read(size_t group) const {
    GroupState out = state[group].read(plan_->groups[group]);
    if (plan_->groups[group].needs.life) births_->read(group, out);
    return out;
}

std::optional<std::vector<GroupState>> Fused::readBefore() const {
    if (births_) return {};      // newborns have taken places since
    if (school_) return {};      // the muscles' clocks have moved on
    if (pieces_ > 1) return {};  // the side of a step within the frame
    std::vector<GroupState> out;
    for (size_t g = 0; g < state.size(); ++g) {
        if (state[g].inPlace()) return {};
        out.push_back(state[g].readBefore(plan_->groups[g]));
        undoRecords(plan_->groups[g], out.back());
    }
    return out;
}

bool Fused::changeLife(size_t group, const Lifecycle& life) {
    return plan_->groups[group].needs.life && births_->change(group, life);
}

bool Fused::changeSchool(size_t group, const School& school) {
    return school_ && school_->change(group, school);
}

void Fused::computeNormals(gpu::PassTimers& timers) {
    if (!drawn_) return;
    const auto timer = timers.time("normals");
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
    for (size_t g = 0; g < state.size(); ++g) {
        if (normals_[g] == nullptr) continue;
        normals_[g]->use();
        for (const GroupBuffers::Part& part : state[g].parts())
            dispatch(*normals_[g], g, part, KernelOptions::Work::normals);
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
}

}  // namespace shoal
