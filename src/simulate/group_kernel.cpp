#include "simulate/group_kernel.h"

#include <algorithm>

namespace shoal {

using gpu::Program;

namespace {

CorotatedStage corotatedStage(const GroupPlan& group, const Parameters& parameters, double h) {
    return {2 * h / 3, std::max(group.drag.normal, group.drag.tangent) * parameters.drag,
            group.stiffness * parameters.stiffness, group.damping * parameters.damping};
}

// Returns, as a key, the parameters that a program is given only once: groups share it where they are equal.
std::string bytesOf(const std::vector<glm::vec4>& parameters) {
    return {reinterpret_cast<const char*>(parameters.data()), parameters.size() * sizeof(glm::vec4)};
}

}  // namespace

GroupKernel::GroupKernel(const KernelSource& source, size_t group, const KernelOptions& options, bool moves,
                         gpu::Programs& programs)
    : source_(source), group_(group), options_(options), programs_(&programs) {
    const GroupPlan& plan = this->group();
    if (plan.factored()) {
        stage_ = corotatedStage(plan, {}, 1 / source.plan->frameRate / source.plan->substeps);
        makeFactors();
    }
    if (plan.needs.liveSprings && options.lanes == Lanes::molecule && !plan.springNumbers.empty())
        springs_ =
            gpu::Texture(*source.context, gpu::Format::rgba32f, int(plan.springNumbers.size()), 1, "springs");
    if (moves) makeStep();
}

const Program& GroupKernel::make(const KernelOptions& options) {
    gpu::ProgramOptions program = kernelProgram(*source_.plan, group_, options);
    if (options.factors.empty())
        return programs_->get(*source_.context, program, bytesOf(group().colliderParameters));
    own_ = std::make_unique<Program>(*source_.context, program);
    return *own_;
}

void GroupKernel::makeStep() {
    step_ = &make(options_);
    step_->use();
    if (group().needs.fields)
        step_->set("givenFieldParameters", std::span<const glm::vec4>(source_.plan->fields.parameters));
    if (group().needs.collide)
        step_->set("givenColliderParameters", std::span<const glm::vec4>(group().colliderParameters));
}

const Program& GroupKernel::also(KernelOptions::Work work) {
    KernelOptions options = options_;
    options.work = work;
    options.factors.clear();  // for a step alone
    return make(options);
}

// A GPU reads the matrix from a buffer. To a CPU rasteriser every read of a uniform is a call: there it
// becomes constants of the program, which is made anew when the step or a slider changes it.
void GroupKernel::makeFactors() {
    const BlockPattern pattern = blockPattern(group().shape, group().needs.pins);
    const std::vector<glm::vec4> factors = corotatedFactors(group().shape, pattern, stage_);
    if (options_.software) {
        options_.factors = corotatedConstants(factors);
        return;
    }
    const size_t bytes = factors.size() * sizeof(glm::vec4);
    if (!factors_)
        factors_ = gpu::Buffer(*source_.context, gpu::Buffer::Use::uniform, nullptr, bytes, "factors");
    factors_.update(gpu::Traffic::Kind::parameters, 0, factors.data(), bytes);
}

void GroupKernel::updateFactors(const Frame& frame) {
    if (!group().factored()) return;
    const CorotatedStage stage = corotatedStage(group(), frame.parameters, frame.h);
    if (stage == stage_) return;
    stage_ = stage;
    makeFactors();
    if (options_.software) makeStep();
}

// Live springs, with their muscles where they are at the start of the frame.
void GroupKernel::updateSprings(const Frame& frame) {
    if (!springs_) return;
    std::vector<glm::vec4> numbers = group().springNumbers;
    const std::vector<glm::vec4> angles = muscleAngles(group().springFrequencies, frame.time);
    for (size_t i = 0; i < group().springFrequencies.size(); ++i)
        numbers[2 * i + 1].w = angles[i / 4][glm::length_t(i % 4)];
    springs_.upload(gpu::Traffic::Kind::parameters, 0, 0, springs_.width(), 1, numbers.data(),
                    numbers.size() * sizeof(glm::vec4));
}

void GroupKernel::update(const Frame& frame) {
    updateFactors(frame);
    updateSprings(frame);
}

const Program& GroupKernel::useStep(const Frame& frame) const {
    step_->use();
    setStepUniforms(*step_, *source_.plan, group(), frame);
    if (factors_) step_->uniformBlock("Factors", factors_);
    return *step_;
}

void GroupKernel::bindTables(const Program& program) const {
    const Tables& tables = *source_.tables;
    tables.bind(program, *source_.plan);
    if (springs_) program.texture("liveSprings", springs_);
    if (options_.lanes != Lanes::vertex) return;
    program.storage("Topology", tables.topologyBuffer);
    program.set("topologyBase", group().topologyBase);
}

}  // namespace shoal
