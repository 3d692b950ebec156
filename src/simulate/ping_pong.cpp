#include "simulate/ping_pong.h"

#include "gpu/gl.h"
#include "gpu/shader_source.h"

namespace shoal {

using gpu::Program;
using gpu::Texture;

namespace {

std::vector<std::string> defines(const GroupPlan& group) {
    const Needs& needs = group.needs;
    std::vector<std::string> out = {"TEXTURES"};
    const auto define = [&](bool need, const char* name) {
        if (need) out.emplace_back(name);
    };
    define(group.solver == SolverKind::leapfrog, "LEAPFROG");
    define(group.solver == SolverKind::verlet, "VERLET");
    define(needs.fields, "FIELDS");
    define(needs.forces, "FORCES");
    define(needs.directionalDrag, "DIRECTIONAL_DRAG");
    define(needs.springs, "SPRINGS");
    define(keepsAcceleration(group), "ACCELERATION");
    define(needs.springDamping, "SPRING_DAMPING");
    if (const Solver& solver = shoal::solver(group.solver); solver.rungeKutta())
        out.push_back(concat("STAGES ", solver.tableau.stages));
    if (needs.actuation) out.push_back(concat("MUSCLES ", muscleAngles(group.muscles, 0).size()));
    define(needs.collide, "COLLIDE");
    out.insert(out.end(), {gpu::constant("PINS", needs.pins), gpu::constant("RELEASE", needs.release),
                           gpu::constant("ANCHORS_MOVE", needs.records)});
    return out;
}

static_assert(stateWidth == 1024, "shaders/state and shaders/passes address rows of 1024 texels");

// Returns, as a key, what a program is given only once, or once a frame, and so must be equal where groups
// share it.
std::string setOnceFor(const GroupPlan& group) {
    std::string out = name(group.solver);
    for (const auto* list : {&group.forces.pulls, &group.forces.thrusts, &group.forces.winds})
        for (const GroupForces::Entry& entry : *list)
            out += concat(" ", entry.force);
    for (const glm::vec4& parameter : group.colliderParameters)
        out.append(reinterpret_cast<const char*>(&parameter), sizeof parameter);
    return out;
}

// How contact reads the textures of passes, a texel a vertex, and changes them.
class VertexTexels : public ContactState {
  public:
    VertexTexels(gpu::Context& context, const Plan& plan, const Tables& tables, TextureState& state)
        : plan_(&plan), tables_(&tables), state_(&state) {
        apply_.resize(plan.groups.size());
        for (const ContactGroup& contact : plan.contact.groups) {
            const GroupPlan& group = plan.groups[contact.group];
            gpu::ProgramOptions options;
            options.vertex = "passes/fullscreen.vert";
            options.fragment = "passes/touched.frag";
            options.defines = {"TEXTURES", concat("ROW_BITS ", rowBits(plan.contact.cells())),
                               gpu::constant("PINS", group.needs.pins),
                               gpu::constant("RELEASE", group.needs.release)};
            options.label = concat("contact apply of ", group.name);
            apply_[contact.group] = Program(context, options);
        }
    }
    Form form() const override { return Form::textures; }
    bool fused() const override { return false; }
    std::vector<std::string> defines(size_t) const override { return {}; }
    std::vector<MoleculeRange> parts(size_t group) const override {
        return {{0, plan_->groups[group].count}};
    }
    void bind(const Program& program, size_t group, size_t) override {
        state_->setGroup(program, group);
        if (program.uses("topology")) program.texture("topology", tables_->topology);
        program.texture("positions", state_->position.read(group));
        program.texture("velocities", state_->velocity.read(group));
        program.texture("records", state_->record.read(group));
        program.texture("constants", state_->constant);
    }
    void apply(size_t group, const Gains& gains) override {
        const TextureState::Rows& rows = state_->rowsOf(group);
        const Program& program = apply_[group];
        program.use();
        bind(program, group, 0);
        gains(program);
        const gpu::Framebuffer& target =
            state_->target({&state_->position.write(group), &state_->velocity.write(group)});
        target.bind(0, rows.firstRow, target.width(), rows.rows);
        gpu::drawVertices(3);
        state_->position.flip(group);
        state_->velocity.flip(group);
    }

  private:
    const Plan* plan_;
    const Tables* tables_;
    TextureState* state_;
    std::vector<Program> apply_;  // per group
};

}  // namespace

PingPong::PingPong(gpu::Context& context, const Plan& plan, const Tables& tables,
                   const SimulationOptions& options)
    : state(context, plan), plan_(&plan), tables_(&tables), drawn_(options.drawn) {
    if (options.watchdog) query_ = std::make_unique<RunawayQuery>(context.traffic());
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        passes_.push_back(passesOf(plan.groups[g]));
        programs_.emplace_back();
        for (const Pass& pass : passes_[g]) {
            const Program*& program = programs_[g][size_t(pass.kind)];
            if (!program && (pass.kind != PassKind::watch || query_))
                program = &makeProgram(context, pass.kind, g);
        }
    }
    if (!plan.contact.any()) return;
    contactState_ = std::make_unique<VertexTexels>(context, plan, tables, state);
    contact_ = std::make_unique<Contact>(context, plan, tables, *contactState_);
}

const Program& PingPong::makeProgram(gpu::Context& context, PassKind kind, size_t index) {
    const Plan& plan = *plan_;
    const GroupPlan& group = plan.groups[index];
    gpu::ProgramOptions wanted;
    wanted.vertex = "passes/fullscreen.vert";
    wanted.fragment = concat("passes/", name(kind), ".frag");
    wanted.defines = defines(group);
    if (kind == PassKind::watch) wanted.defines.push_back(fastestDefine());
    if (const ContactGroup* contact = plan.contact.find(index)) {
        if (plan.contact.remembers())
            wanted.defines.insert(wanted.defines.end(),
                                  {"REMEMBERS", concat("ROW_BITS ", rowBits(plan.contact.cells()))});
        for (const std::string& define : contact->defines())
            wanted.defines.push_back(define);
    }
    wanted.generated = {{"generated/fields.glsl", plan.fields.source},
                        {"generated/stages.glsl", group.kernel.stages},
                        {"generated/scene_forces.glsl", group.forces.source},
                        {"generated/colliders.glsl", plan.colliders.source}};
    wanted.label = concat(name(kind), " of ", group.name);
    const Program& program = made_.get(context, wanted, setOnceFor(group));
    program.use();
    if (program.uses("colliderParameters"))
        program.set("colliderParameters", std::span<const glm::vec4>(group.colliderParameters));
    return program;
}

void PingPong::computeNormals(gpu::PassTimers& timers) {
    if (!drawn_) return;
    gpu::drawPlainly();
    const Frame still;
    run(Pass::When::frameEnd, {0, 0, true, still}, timers);
}

void PingPong::run(Pass::When when, const Step& step, gpu::PassTimers& timers) {
    for (size_t g = 0; g < passes_.size(); ++g)
        for (const Pass& pass : passes_[g])
            if (pass.when == when && pass.kind != PassKind::watch) runPass(g, pass, step, timers);
}

void PingPong::runSubsteps(const Frame& frame, gpu::PassTimers& timers) {
    run(Pass::When::frameStart, {frame.time, frame.h, true, frame}, timers);
    for (int i = 0; i < frame.parameters.substeps; ++i)
        run(Pass::When::substep, {frame.time + i * frame.h, frame.h, i == 0, frame}, timers);
}

void PingPong::step(const Frame& frame, gpu::PassTimers& timers) {
    gpu::drawPlainly();
    const int steps = contact_ ? std::min(plan_->contact.steps, frame.parameters.substeps) : 1;
    for (int i = 0; i < steps; ++i) {
        const Frame piece = pieceOf(frame, i, steps);
        runSubsteps(piece, timers);  // contact moves what springs had been evaluated at
        if (contact_) contact_->step(piece, timers);
    }
    if (drawn_)
        run(Pass::When::frameEnd, {frame.time + frame.parameters.frameTime, frame.h, false, frame}, timers);
    if (query_) watch(timers);
}

// All groups in one query, which the next frame reads. Nothing is drawn: the target is the side that is not
// read, with its colours masked.
void PingPong::watch(gpu::PassTimers& timers) {
    const RunawayQuery::Asking asking(*query_);
    for (size_t g = 0; g < passes_.size(); ++g) {
        const auto timer = timers.time(name(PassKind::watch));
        prepare(PassKind::watch, g);
        drawState(g, {&state.velocity.write(g)});
    }
}

void PingPong::runPass(size_t index, const Pass& pass, const Step& step, gpu::PassTimers& timers) {
    const GroupPlan& group = plan_->groups[index];
    const auto timer = timers.time(name(pass.kind));
    switch (pass.kind) {
    case PassKind::records:
        return records(group, index, step);
    case PassKind::normals:
        return normals(group, index, step, pass.when == Pass::When::substep);
    case PassKind::thrust:
        return thrust(group, index, step);
    case PassKind::restore:
        return restore(group, index, step, pass.when == Pass::When::frameStart);
    case PassKind::advect:
        return advect(group, index, step);
    case PassKind::stage:
        for (int s = 0; s < solver(group.solver).tableau.stages; ++s)
            stage(group, index, step, s);
        return;
    case PassKind::collide:
        return collide(group, index, step);
    case PassKind::watch:  // not one by one
        return;
    }
}

// Binds what every pass reads: the group's place, its state and the tables.
const Program& PingPong::prepare(PassKind kind, size_t index) {
    const Program& program = *programs_[index][size_t(kind)];
    program.use();
    state.setGroup(program, index);
    program.texture("positions", state.position.read(index));
    program.texture("velocities", state.velocity.read(index));
    if (state.acceleration) program.texture("accelerations", state.acceleration.read(index));
    program.texture("records", state.record.read(index));
    program.texture("constants", state.constant);
    program.texture("topology", tables_->topology);
    tables_->bind(program, *plan_);
    if (state.normal && program.uses("vertexNormals")) program.texture("vertexNormals", state.normal);
    if (program.uses("contactLoads")) contact_->bindLoads(program, index);
    return program;
}

void PingPong::setSprings(const Program& program, const GroupPlan& group, const Step& step,
                          double predictTime) {
    program.set("stiffnessFactor", float(group.stiffness * step.frame.parameters.stiffness));
    program.set("dampingFactor", float(group.damping * step.frame.parameters.damping));
    if (group.needs.actuation)
        program.set("muscleAngles", std::span<const glm::vec4>(muscleAngles(group.muscles, step.frame.time)));
    program.set("predictTime", float(predictTime));
    if (group.solver == SolverKind::verlet) program.set("substep", float(step.h));
}

// Sets what fields, forces and colliders are told once a frame.
void PingPong::setParameters(const Program& program, const GroupPlan& group, const Step& step) {
    if (!step.first) return;
    if (program.uses("fieldParameters"))
        program.set("fieldParameters", std::span<const glm::vec4>(fieldParameters(*plan_, step.frame)));
    if (program.uses("forceParameters"))
        program.set("forceParameters",
                    std::span<const glm::vec4>(forceParameters(*plan_, group, step.frame)));
    if (program.uses("colliderParameters") && !plan_->colliders.moving.empty())
        program.set("colliderParameters",
                    std::span<const glm::vec4>(colliderParameters(*plan_, group, step.frame)));
}

void PingPong::draw(size_t index, int firstRow, int rows, const Targets& targets) {
    state.target(targets).bind(0, firstRow, std::min(stateWidth, plan_->groups[index].count), rows);
    gpu::drawVertices(3);
}

void PingPong::drawState(size_t index, const Targets& targets) {
    draw(index, state.rowsOf(index).firstRow, state.rowsOf(index).rows, targets);
}

void PingPong::drawVelocity(size_t index) {
    drawState(index, {&state.velocity.write(index)});
    state.velocity.flip(index);
}

void PingPong::drawMotion(size_t index) {
    drawState(index, {&state.position.write(index), &state.velocity.write(index)});
    state.position.flip(index);
    state.velocity.flip(index);
}

void PingPong::records(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::records, index);
    if (group.needs.release) {
        const ReleaseLimits limits = releaseLimits(group, step.frame);
        setSprings(program, group, step, 0);
        program.set("springTime", float(step.time - step.frame.time));
        program.set("releaseForce", limits.force);
        program.set("releaseChance", limits.chance);
        program.set("frame", step.frame.number);
    }
    const TextureState::Rows& rows = state.rowsOf(index);
    draw(index, rows.firstRecordRow, rows.slabRows, {&state.record.write(index)});
    state.record.flip(index);
}

void PingPong::normals(const GroupPlan& group, size_t index, const Step& step, bool ahead) {
    const Program& program = prepare(PassKind::normals, index);
    const bool halfDrift = ahead && group.solver == SolverKind::leapfrog;
    program.set("aheadTime", float(halfDrift ? step.h / 2 : 0));
    drawState(index, {&state.normal});
}

void PingPong::thrust(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::thrust, index);
    setParameters(program, group, step);
    program.set("whole", int(shoal::solver(group.solver).order == 1));
    drawVelocity(index);
}

void PingPong::restore(const GroupPlan& group, size_t index, const Step& step, bool frameStart) {
    const Program& program = prepare(PassKind::restore, index);
    const bool leapfrog = group.solver == SolverKind::leapfrog, atEnd = leapfrog && !frameStart;
    setSprings(program, group, step, atEnd ? step.h / 2 : 0);
    program.set("springTime", float(step.time - step.frame.time + (atEnd ? step.h : 0)));
    program.set("kickTime", float(frameStart ? 0 : leapfrog ? step.h / 2 : step.h));
    if (!keepsAcceleration(group)) return drawVelocity(index);
    Targets targets = {&state.acceleration.write(index)};
    if (!frameStart) targets.push_back(&state.velocity.write(index));
    drawState(index, targets);
    state.acceleration.flip(index);
    if (!frameStart) state.velocity.flip(index);
}

void PingPong::advect(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::advect, index);
    const DragCoefficients drag = dragCoefficients(group, step.frame.parameters, step.h);
    setParameters(program, group, step);
    program.set("time", float(step.time - step.frame.time));
    program.set("substep", float(step.h));
    program.set("gravity", glm::vec3(step.frame.parameters.gravity));
    program.set("wind", float(step.frame.parameters.wind));
    program.set("decay", drag.decay);
    program.set("phi", drag.phi);
    program.set("slips", int(drag.slips));
    program.set("moveAnchors", int(step.first && group.needs.records));
    drawMotion(index);
}

// Stage s of a substep reads side s - 1 of the stages, or the state, and writes side s, or the new state.
void PingPong::stage(const GroupPlan& group, size_t index, const Step& step, int s) {
    const size_t read = size_t(s + 1) % 2, write = size_t(s) % 2;
    const Texture& position = s == 0 ? state.position.read(index) : state.stagePosition[read];
    const Texture& velocity = s == 0 ? state.velocity.read(index) : state.stageVelocity[read];
    if (group.needs.directionalDrag) {
        const Program& normals = prepare(PassKind::normals, index);
        normals.texture("positions", position);
        normals.set("aheadTime", 0.0f);
        drawState(index, {&state.normal});
    }
    const Program& program = prepare(PassKind::stage, index);
    if (group.needs.springs) setSprings(program, group, step, 0);
    if (s == 0) setParameters(program, group, step);
    program.texture("positions", position);
    program.texture("velocities", velocity);
    program.texture("startPositions", state.position.read(index));
    program.texture("startVelocities", state.velocity.read(index));
    program.texture("sumVelocities", state.sumVelocity[read]);
    program.texture("sumAccelerations", state.sumAcceleration[read]);
    program.set("time", float(step.time - step.frame.time));
    program.set("substep", float(step.h));
    program.set("stage", s);
    program.set("gravity", glm::vec3(step.frame.parameters.gravity));
    program.set("wind", float(step.frame.parameters.wind));
    program.set("dragRate",
                glm::vec2(group.drag.normal, group.drag.tangent) * float(step.frame.parameters.drag));
    program.set("moveAnchors", int(step.first && group.needs.records));
    const bool last = s + 1 == solver(group.solver).tableau.stages;
    drawState(index, {last ? &state.position.write(index) : &state.stagePosition[write],
                      last ? &state.velocity.write(index) : &state.stageVelocity[write],
                      &state.sumVelocity[write], &state.sumAcceleration[write]});
    if (!last) return;
    state.position.flip(index);
    state.velocity.flip(index);
}

void PingPong::collide(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::collide, index);
    program.set("gravity", glm::vec3(step.frame.parameters.gravity));
    const DragCoefficients drag = dragCoefficients(group, step.frame.parameters, step.h);
    program.set("drift", driftOf(group.solver, step.h, drag.slips));
    if (const int stages = solver(group.solver).tableau.stages;
        stages > 0)  // that the last stage has written
        program.texture("sumAccelerations", state.sumAcceleration[size_t(stages - 1) % 2]);
    if (!plan_->colliders.moving.empty())
        program.set("contactTime", float(step.time + step.h - step.frame.time));
    setParameters(program, group, step);
    drawMotion(index);
}

}  // namespace shoal
