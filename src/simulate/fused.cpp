#include "simulate/fused.h"

#include "gpu/buffer.h"
#include "simulate/watchdog.h"

namespace shoal {

using gpu::Program;

namespace {

namespace unit {
constexpr int oldState = 0, oldRecords = 1, constants = 2, samples = 3, topology = 4, springs = 5,
              steering = 6;
}
namespace binding {
constexpr int newState = 0, newRecords = 1, newNormals = 2, alarm = 3;
}

CorotatedStage corotatedStage(const GroupPlan& group, const Parameters& parameters, double h) {
    return {2 * h / 3, std::max(group.drag.normal, group.drag.tangent) * parameters.drag,
            group.stiffness * parameters.stiffness, group.damping * parameters.damping};
}

// Returns, as a key, the parameters that a program is given only once: groups share it where they are equal.
std::string bytesOf(const std::vector<glm::vec4>& parameters) {
    return {reinterpret_cast<const char*>(parameters.data()), parameters.size() * sizeof(glm::vec4)};
}

}  // namespace

PathLimits limitsOf(const gpu::ContextInfo& info) {
    PathLimits out;
    out.version = concat(info.major, ".", info.minor);
    out.compute = info.computeShaders;
    out.software = info.software;
    out.maxTextureSize = info.maxTextureSize;
    out.maxSharedBytes = info.maxSharedBytes;
    out.maxUniformComponents = info.maxComputeUniformComponents;
    out.maxUniformBlockBytes = info.maxUniformBlockBytes;
    return out;
}

Fused::Fused(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
             const SimulationOptions& options)
    : context_(&context),
      shaderRoot_(shaderRoot),
      plan_(&plan),
      tables_(&tables),
      drawn_(options.drawn),
      cache_(options.cache) {
    const gpu::ContextInfo& info = context.info();
    constexpr uint32_t fine = 0;
    if (options.watchdog)
        alarm_ = gpu::Buffer(context, gpu::Buffer::Use::storage, &fine, sizeof fine, "alarm");
    if (plan.hasLife()) births_ = std::make_unique<Births>(context, shaderRoot, plan, tables, options.cache);
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        KernelOptions kernel;
        kernel.lanes = chooseLanes(group, options.lanes, limitsOf(info));
        // contact still moves what a dispatch leaves, and newborns come after it
        kernel.normals = options.drawn && !plan.contact.any() && !group.needs.life;
        kernel.groupVote = info.groupVote;
        kernel.software = info.software;
        kernel.watch = options.watchdog;
        const size_t perWorkgroup =
            kernel.lanes == Lanes::molecule ? size_t(workgroupLanes(group, kernel.lanes)) : 1;
        state.emplace_back(context, group, options.drawn, options.inPlace,
                           size_t(info.maxWorkGroupsX) * perWorkgroup);

        Kernel& made = kernels_.emplace_back();
        made.options = kernel;
        if (group.factored()) {
            Parameters parameters;
            made.stage = corotatedStage(group, parameters, 1 / plan.frameRate / plan.substeps);
            makeFactors(g);
        }
        if (group.needs.liveSprings) {
            made.springs = gpu::Buffer(context, gpu::Buffer::Use::storage,
                                       std::span<const glm::vec4>(group.springNumbers), "springs");
            made.springTexels = gpu::BufferTexture(context, made.springs, "springs");
        }
        makeStep(g);
        if (!options.drawn || !group.needs.normals) continue;
        kernel.normals = kernel.onlyNormals = true;
        gpu::ProgramOptions program = kernelProgram(plan, g, kernel);
        program.cache = options.cache;
        made.normals = &programs_.get(context, shaderRoot, program);
    }
    if (plan.contact.any())
        contact_ = std::make_unique<MoleculeContact>(context, shaderRoot, plan, tables, options.cache);
    if (plan.school.any())
        school_ = std::make_unique<Schooling>(context, shaderRoot, plan, tables, options.cache);
}

void Fused::makeStep(size_t index) {
    const GroupPlan& group = plan_->groups[index];
    Kernel& kernel = kernels_[index];
    gpu::ProgramOptions program = kernelProgram(*plan_, index, kernel.options);
    program.cache = cache_;
    if (kernel.options.factors.empty()) {
        kernel.step = &programs_.get(*context_, shaderRoot_, program, bytesOf(group.colliderParameters));
    } else {
        kernel.own = std::make_unique<Program>(*context_, shaderRoot_, program);
        kernel.step = kernel.own.get();
    }
    kernel.step->use();
    if (group.needs.fields)
        kernel.step->set("givenFieldParameters", std::span<const glm::vec4>(plan_->fieldParameters));
    if (group.needs.collide)
        kernel.step->set("givenColliderParameters", std::span<const glm::vec4>(group.colliderParameters));
}

// A GPU reads the matrix from a buffer. To a CPU rasteriser every read of a uniform is a call: there it
// becomes constants of the program, which is made anew when the step or a slider changes it.
void Fused::makeFactors(size_t index) {
    const GroupPlan& group = plan_->groups[index];
    Kernel& kernel = kernels_[index];
    const CorotatedPattern pattern = corotatedPattern(group.shape, group.needs.pins);
    const std::vector<glm::vec4> factors = corotatedFactors(group.shape, pattern, kernel.stage);
    if (kernel.options.software) {
        kernel.options.factors = corotatedConstants(factors);
        return;
    }
    const size_t bytes = factors.size() * sizeof(glm::vec4);
    if (!kernel.factors)
        kernel.factors = gpu::Buffer(*context_, gpu::Buffer::Use::uniform, nullptr, bytes, "factors");
    kernel.factors.update(gpu::Traffic::Kind::parameters, 0, factors.data(), bytes);
}

void Fused::updateFactors(size_t index, const Frame& frame) {
    const GroupPlan& group = plan_->groups[index];
    if (!group.factored()) return;
    Kernel& kernel = kernels_[index];
    const CorotatedStage stage = corotatedStage(group, frame.parameters, frame.h);
    if (!(stage == kernel.stage)) {
        kernel.stage = stage;
        makeFactors(index);
        if (kernel.options.software) makeStep(index);
    }
    if (kernel.factors) kernel.step->uniformBlock("Factors", 0, kernel.factors);
}

// Live springs, with their muscles where they are at the start of the frame.
void Fused::updateSprings(size_t index, const Frame& frame) {
    const GroupPlan& group = plan_->groups[index];
    if (!group.needs.liveSprings || kernels_[index].options.lanes != Lanes::molecule) return;
    std::vector<glm::vec4> numbers = group.springNumbers;
    const std::vector<glm::vec4> angles = muscleAngles(group.springFrequencies, frame.time);
    for (size_t i = 0; i < group.springFrequencies.size(); ++i)
        numbers[2 * i + 1].w = angles[i / 4][glm::length_t(i % 4)];
    kernels_[index].springs.update(gpu::Traffic::Kind::parameters, 0, numbers.data(),
                                   numbers.size() * sizeof(glm::vec4));
}

void Fused::bind(const Program& program, size_t index, const GroupBuffers::Part& part) const {
    const GroupPlan& group = plan_->groups[index];
    const GroupBuffers& buffers = state[index];
    program.texture("oldState", unit::oldState, buffers.oldState(part));
    program.texture("oldRecords", unit::oldRecords, part.record);
    if (buffers.hasConstants()) program.texture("constants", unit::constants, part.constant);
    if ((group.needs.fields || group.needs.collide) && tables_->sampleTexels)
        program.texture("samples", unit::samples, tables_->sampleTexels);
    if (group.needs.liveSprings && kernels_[index].options.lanes == Lanes::molecule)
        program.texture("liveSprings", unit::springs, kernels_[index].springTexels);
    if (group.needs.steers && !kernels_[index].options.onlyNormals)
        program.texture("steering", unit::steering, part.steering);
    if (kernels_[index].options.lanes == Lanes::vertex) {
        program.texture("topology", unit::topology, tables_->topology);
        program.set("topologyBase", group.topologyBase);
    }
    store(program, "NewState", binding::newState, buffers.newState(part));
    if (group.needs.records) store(program, "NewRecords", binding::newRecords, buffers.records(part));
    const bool writesNormals = kernels_[index].options.normals || &program == kernels_[index].normals;
    if (buffers.hasNormals() && writesNormals)
        store(program, "NewNormals", binding::newNormals, buffers.normals(part));
}

void Fused::dispatch(const Program& program, size_t index, const GroupBuffers::Part& part) const {
    bind(program, index, part);
    const int lanes = workgroupLanes(plan_->groups[index], kernels_[index].options.lanes);
    if (births_ && births_->has(index) && &program == kernels_[index].step) {
        births_->bindStep(program, index);
        return births_->dispatchStep(program, index, lanes);
    }
    program.dispatch(kernels_[index].options.lanes == Lanes::molecule ? (part.count + lanes - 1) / lanes
                                                                      : part.count);
}

void Fused::step(const Frame& frame, gpu::PassTimers& timers) {
    steeringEnd_ = frame.end;
    if (school_) school_->step(frame, state, timers);
    if (!contact_) {
        run(frame, timers);
        if (births_) births_->step(frame, state, timers);
        if (births_) computeNormals(timers);
        return;
    }
    const int steps = std::min(plan_->contact.steps, frame.parameters.substeps);
    for (int i = 0; i < steps; ++i) {
        const Frame piece = pieceOf(frame, i, steps);
        run(piece, timers);
        if (births_) births_->step(piece, state, timers);
        contact_->step(piece, state, timers);
    }
    computeNormals(timers);
}

void Fused::run(const Frame& frame, gpu::PassTimers& timers) {
    const auto timer = timers.time("fused");
    gpu::barrier(
        {gpu::Barrier::textureFetch, gpu::Barrier::storage});  // a picture may still read what is written
    for (size_t g = 0; g < state.size(); ++g) {
        updateFactors(g, frame);
        updateSprings(g, frame);
        const Program& program = *kernels_[g].step;
        program.use();
        setStepUniforms(program, *plan_, plan_->groups[g], frame);
        if (plan_->groups[g].needs.steers) program.set("givenSteeringEnd", float(steeringEnd_ - frame.time));
        if (alarm_) program.storage("Alarm", binding::alarm, alarm_);
        for (const GroupBuffers::Part& part : state[g].parts())
            dispatch(program, g, part);
        state[g].flip();
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
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
    if (births_) return {};                               // newborns have taken places since
    if (school_) return {};                               // the muscles' clocks have moved on
    if (contact_ && plan_->contact.steps > 1) return {};  // the side of a step within the frame
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

bool Fused::alarmed() const {
    uint32_t raised = 0;
    if (alarm_) alarm_.download(gpu::Traffic::Kind::control, 0, &raised, sizeof raised);
    return raised != 0;
}

void Fused::disarm() {
    constexpr uint32_t fine = 0;
    if (alarm_) alarm_.update(gpu::Traffic::Kind::control, 0, &fine, sizeof fine);
}

void Fused::computeNormals(gpu::PassTimers& timers) {
    if (!drawn_) return;
    const auto timer = timers.time("normals");
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
    for (size_t g = 0; g < state.size(); ++g) {
        if (kernels_[g].normals == nullptr) continue;
        const Program& program = *kernels_[g].normals;
        program.use();
        for (const GroupBuffers::Part& part : state[g].parts())
            dispatch(program, g, part);
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
}

}  // namespace shoal
