#include "simulate/fused.h"

#include <algorithm>

#include "compile/newton.h"
#include "gpu/buffer.h"
#include "gpu/gl.h"

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

// How contact reads the state, and changes it.
class Fused::Touched : public ContactState {
  public:
    explicit Touched(Fused& path) : path_(&path) {}
    Form form() const override { return path_->form_; }
    std::vector<std::string> defines(size_t group) const override {
        std::vector<std::string> out = path_->plan_->groups[group].layout().defines(path_->textures());
        if (path_->state(group).hasConstants()) out.emplace_back("CONSTANTS");
        return out;
    }
    std::vector<MoleculeRange> parts(size_t group) const override { return path_->state(group).ranges(); }
    void bind(const Program& program, size_t group, size_t part) override {
        path_->state(group).bindRead(program, part);
        if (!program.declares("State")) return;
        const GroupBuffers& buffers = path_->buffers[group];
        store(program, "State", buffers.currentState(buffers.parts()[part]));
    }
    void apply(size_t group, const Gains& gains) override {
        if (path_->groups_[group].touched == nullptr) return;
        const Program& program = *path_->groups_[group].touched;
        program.use();
        program.set("groupMolecules", path_->plan_->groups[group].count);
        gains(program);
        path_->bind(program, group, 0);
        path_->state(group).run(program, 0, PackedState::Output::state);
        path_->state(group).flip();
    }

  private:
    Fused* path_;
};

Fused::Fused(gpu::Context& context, const Plan& plan, const Tables& tables, const SimulationOptions& options,
             Form form)
    : plan_(&plan), form_(form) {
    const gpu::ContextInfo& info = context.info();
    // with contact, births and schools other passes change the state as well
    ahead_ = !textures() && options.watchdog && options.asOnGpu.value_or(!info.software) &&
             info.atLeast(4, 4) && !plan.contact.any() && !plan.hasLife() && !plan.school.any();
    using Reading = RunawayWord::Reading;
    if (options.watchdog && textures()) query_.emplace(context.traffic());
    if (options.watchdog && !textures())
        word_.emplace(context, !ahead_                       ? Reading::waits
                               : options.asOnGpu.has_value() ? Reading::late
                                                             : Reading::ahead);
    for (size_t g = 0; g < plan.groups.size(); ++g)
        makeGroup(context, {&context, &plan, &tables}, g, options);
    if (plan.contact.any()) {
        contactState_ = std::make_unique<Touched>(*this);
        contact_ = std::make_unique<Contact>(context, plan, tables, *contactState_, options.asOnGpu);
    }
    if (plan.hasLife() && textures())
        births_ = std::make_unique<TextureBirths>(context, plan, tables, layers);
    else if (plan.hasLife())
        births_ = std::make_unique<BufferBirths>(context, plan, tables, buffers);
    if (plan.school.any() && textures())
        school_ = std::make_unique<TextureSchool>(context, plan, tables, layers);
    else if (plan.school.any())
        school_ = std::make_unique<BufferSchool>(context, plan, tables, buffers);
}

KernelOptions Fused::kernelOptions(const gpu::ContextInfo& info, const GroupPlan& group,
                                   const SimulationOptions& options) const {
    KernelOptions out;
    out.groupVote = info.groupVote;
    out.software = info.software;
    if (textures()) {
        out.targets = info.maxColorAttachments;
        return out;
    }
    out.lanes = chooseLanes(*plan_, group, options.lanes, limitsOf(info));
    out.sharedBytes = info.maxSharedBytes;
    // contact still moves what a dispatch leaves, and newborns come after it
    out.normals = options.drawn && !plan_->contact.any() && !group.needs.life;
    out.watch = options.watchdog;
    out.ahead = ahead_;
    return out;
}

void Fused::makeGroup(gpu::Context& context, const KernelSource& source, size_t index,
                      const SimulationOptions& options) {
    const GroupPlan& plan = plan_->groups[index];
    const KernelOptions kernel = kernelOptions(context.info(), plan, options);
    if (kernel.software && plan.needs.collide)
        mostVertices_ = std::max(mostVertices_, verticesOfLane(plan, kernel));
    if (kernel.software && solver(plan.solver).spread)
        matrixTurns_ =
            std::max(matrixTurns_, newtonTurns(plan, workgroupShape(plan.vertexCount, kernel.sharedBytes)));
    if (textures())
        layers.emplace_back(context, plan, options.drawn, *kernel.targets);
    else
        buffers.emplace_back(context, plan, options.drawn, options.inPlace, workgroupMolecules(plan, kernel),
                             options.largestPart);
    Group& group = groups_.emplace_back();
    const bool moves = !plan.isStill();
    group.kernel = std::make_unique<GroupKernel>(source, index, kernel, moves, programs_);
    const auto also = [&](bool need, KernelOptions::Work work) {
        return need ? &group.kernel->also(work) : nullptr;
    };
    group.normals = also(state(index).hasNormals(), KernelOptions::Work::normals);
    group.watch = also(query_ && moves, KernelOptions::Work::watch);
    group.touched = also(textures() && plan_->contact.find(index) && moves, KernelOptions::Work::touched);
}

const PackedState& Fused::state(size_t group) const {
    if (textures()) return layers[group];
    return buffers[group];
}

void Fused::settle() const {
    if (textures()) return gpu::drawPlainly();
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage, gpu::Barrier::bufferUpdate});
}

void Fused::bind(const Program& program, size_t group, size_t range) const {
    state(group).bindRead(program, range);
    groups_[group].kernel->bindTables(program);
}

void Fused::step(const Frame& frame, gpu::PassTimers& timers) {
    steeringEnd_ = frame.end;
    if (school_) school_->step(frame, timers);
    pieces_ =
        piecesOf(*plan_, mostVertices_, matrixTurns_, frame.parameters.substeps, gpu::mostSoftwareTurns);
    for (int i = 0; i < pieces_; ++i) {
        const Frame piece = pieceOf(frame, i, pieces_);
        if (contact_) contact_->begin(piece);
        run(piece, timers);
        if (births_) births_->step(piece, timers);
        if (contact_) contact_->step(piece, timers);
    }
    if (word_) word_->endFrame(frame.number);
    if (textures() || contact_ || births_) computeNormals(timers);
    if (query_) watch(timers);
}

void Fused::run(const Frame& frame, gpu::PassTimers& timers) {
    const auto timer = timers.time("fused");
    settle();  // a picture may still read what is written
    for (size_t g = 0; g < groups_.size(); ++g) {
        GroupKernel& kernel = *groups_[g].kernel;
        if (!kernel.moves()) continue;
        kernel.update(frame);
        const Program& program = kernel.useStep(frame);
        if (plan_->groups[g].needs.steers) program.set("givenSteeringEnd", float(steeringEnd_ - frame.time));
        if (word_) word_->bind(program);
        const std::vector<MoleculeRange> ranges = state(g).ranges();
        for (size_t r = 0; r < ranges.size(); ++r) {
            bind(program, g, r);
            if (contact_) contact_->bindLoads(program, g, ranges[r].first);
            if (births_ && births_->has(g))
                births_->runStep(program, g, r);
            else
                state(g).run(program, r, PackedState::Output::state);
        }
        state(g).flip();
    }
    settle();
}

void Fused::computeNormals(gpu::PassTimers& timers) {
    if (std::none_of(groups_.begin(), groups_.end(), [](const Group& group) { return group.normals; }))
        return;
    const auto timer = timers.time("normals");
    settle();
    for (size_t g = 0; g < groups_.size(); ++g) {
        if (groups_[g].normals == nullptr) continue;
        groups_[g].normals->use();
        const size_t ranges = state(g).ranges().size();
        for (size_t r = 0; r < ranges; ++r) {
            bind(*groups_[g].normals, g, r);
            state(g).run(*groups_[g].normals, r, PackedState::Output::normals);
        }
    }
    settle();
}

// Nothing is drawn: the target is the side that is not read, with its colours masked.
void Fused::watch(gpu::PassTimers& timers) {
    const auto timer = timers.time("watch");
    const RunawayQuery::Asking asking(*query_);
    for (size_t g = 0; g < groups_.size(); ++g) {
        if (groups_[g].watch == nullptr) continue;
        groups_[g].watch->use();
        bind(*groups_[g].watch, g, 0);
        state(g).run(*groups_[g].watch, 0, PackedState::Output::nothing);
    }
}

std::optional<int> Fused::framesSinceAlarm(bool waits) {
    if (query_) return query_->framesSince();
    return word_ ? word_->framesSince(waits) : std::nullopt;
}

// The kernels of these frames have changed nothing.
void Fused::goBack(int frames) {
    if (frames == 0) return;
    word_->goBack(frames);
    for (size_t g = 0; g < groups_.size(); ++g)
        if (frames % 2 == 1 && groups_[g].kernel->moves()) state(g).flip();
}

void Fused::disarm() {
    if (query_) query_->disarm();
    if (word_) word_->disarm();
}

std::optional<std::vector<GroupState>> Fused::readBefore() const {
    if (births_) return {};                 // newborns have taken places since
    if (school_) return {};                 // the muscles' clocks have moved on
    if (pieces_ > 1) return {};             // the side of a step within the frame
    if (textures() && contact_) return {};  // which gives the state another side
    std::vector<GroupState> out;
    for (size_t g = 0; g < groups_.size(); ++g) {
        const GroupPlan& group = plan_->groups[g];
        if (!groups_[g].kernel->moves()) {
            out.push_back(state(g).read(group));
            continue;
        }
        if (!state(g).hasBefore()) return {};
        out.push_back(state(g).readBefore(group));
        if (!textures()) undoRecords(group, out.back());
    }
    return out;
}

void Fused::write(size_t group, const GroupState& groupState, double time) {
    state(group).write(plan_->groups[group], groupState);
    if (plan_->groups[group].needs.life) births_->write(group, groupState, time);
}

GroupState Fused::read(size_t group) const {
    GroupState out = state(group).read(plan_->groups[group]);
    if (plan_->groups[group].needs.life) births_->read(group, out);
    return out;
}

bool Fused::changeLife(size_t group, const Lifecycle& life) {
    return plan_->groups[group].needs.life && births_->change(group, life);
}

bool Fused::changeSchool(size_t group, const School& school) {
    return school_ && school_->change(group, school);
}

}  // namespace shoal
