#include "simulate/simulation.h"

#include <cmath>
#include <limits>

#include "gpu/gl.h"

namespace shoal {

using gpu::Framebuffer;
using gpu::Program;
using gpu::Texture;

namespace {

constexpr const char* fragmentShaders[] = {"passes/records.frag", "passes/normals.frag",
                                           "passes/restore.frag", "passes/advect.frag",
                                           "passes/collide.frag"};

std::vector<std::string> defines(const GroupPlan& group) {
    const Needs& needs = group.needs;
    std::vector<std::string> out;
    const auto define = [&](bool need, const char* name) {
        if (need) out.emplace_back(name);
    };
    define(group.solver == SolverKind::leapfrog, "LEAPFROG");
    define(needs.acceleration && needs.springDamping, "PREDICT");
    define(needs.fields, "FIELDS");
    define(needs.directionalDrag, "DIRECTIONAL_DRAG");
    define(needs.directionalDrag && group.solver == SolverKind::leapfrog, "AHEAD");
    define(needs.springs, "SPRINGS");
    define(needs.springDamping, "SPRING_DAMPING");
    define(needs.actuation, "ACTUATION");
    define(needs.pins, "PINS");
    define(needs.release, "RELEASE");
    define(needs.records, "RECORDS");
    return out;
}

static_assert(stateWidth == 1024, "shaders/lib and shaders/passes address rows of 1024 texels");

// phi = (1 - exp(-gamma h)) / gamma, and gamma phi: in double, where the difference to h still counts.
double decayOf(double gamma, double h) {
    return -std::expm1(-gamma * h);
}
double phiOf(double gamma, double h) {
    return std::abs(gamma * h) < 1e-12 ? h : decayOf(gamma, h) / gamma;
}

// Passes write every texel of their rows as it is, whatever a renderer left switched on.
void drawPlainly() {
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB})
        glDisable(state);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace

Simulation::Simulation(gpu::Context& context, const std::string& shaderRoot, Plan plan, bool drawn,
                       gpu::PassTimers::Mode timing)
    : context_(&context),
      plan_(std::move(plan)),
      drawn_(drawn),
      state_(context, plan_),
      noAttributes_(context, "pass"),
      timers_(context, timing) {
    parameters.gravity = plan_.gravity;
    parameters.substeps = plan_.substeps;
    parameters.frameTime = 1 / plan_.frameRate;

    programs_.resize(plan_.groups.size());
    for (const PassPlan& pass : plan_.passes) {
        Program& program = programs_[pass.group][size_t(pass.kind)];
        if (program) continue;
        gpu::ProgramOptions options;
        options.vertex = "passes/fullscreen.vert";
        options.fragment = fragmentShaders[size_t(pass.kind)];
        options.defines = defines(plan_.groups[pass.group]);
        options.generated = {{"generated/fields.glsl", plan_.fieldSource},
                             {"generated/colliders.glsl", plan_.collideSource}};
        options.label = concat(name(pass.kind), " of ", plan_.groups[pass.group].name);
        program = Program(context, shaderRoot, options);
        program.use();
        if (pass.kind == PassKind::advect && plan_.groups[pass.group].needs.fields)
            program.set("fieldParameters", std::span<const glm::vec4>(plan_.fieldParameters));
        if (pass.kind == PassKind::collide)
            program.set("colliderParameters", std::span<const glm::vec4>(plan_.colliderParameters));
    }
    restart();
}

void Simulation::restart() {
    state_.upload(plan_);
    time_ = 0;
    frames_ = 0;
    // what is drawn before the first frame needs normals, too
    drawPlainly();
    for (const PassPlan& pass : plan_.passes)
        if (pass.when == PassPlan::When::frameEnd && drawn_) runPass(pass, {0, 0, true});
}

void Simulation::frame() {
    drawPlainly();
    timers_.beginFrame();
    const double h = parameters.frameTime / parameters.substeps;
    const auto run = [&](PassPlan::When when, const Step& step) {
        for (const PassPlan& pass : plan_.passes)
            if (pass.when == when) runPass(pass, step);
    };
    run(PassPlan::When::frameStart, {time_, h, true});
    for (int i = 0; i < parameters.substeps; ++i)
        run(PassPlan::When::substep, {time_ + i * h, h, i == 0});
    time_ += parameters.frameTime;
    ++frames_;
    if (drawn_) run(PassPlan::When::frameEnd, {time_, h, false});
    timers_.endFrame();
}

void Simulation::runPass(const PassPlan& pass, const Step& step) {
    const GroupPlan& group = plan_.groups[pass.group];
    const auto timer = timers_.time(name(pass.kind));
    switch (pass.kind) {
    case PassKind::records:
        return records(group, pass.group, step);
    case PassKind::normals:
        return normals(group, pass.group, step, pass.when == PassPlan::When::substep);
    case PassKind::restore:
        return restore(group, pass.group, step, pass.when == PassPlan::When::frameStart);
    case PassKind::advect:
        return advect(group, pass.group, step);
    case PassKind::collide:
        return collide(group, pass.group, step);
    }
}

// Binds what every pass reads: the group's place, its state and the tables.
const Program& Simulation::prepare(PassKind kind, const GroupPlan& group, size_t index) {
    const Program& program = programs_[index][size_t(kind)];
    program.use();
    program.set("firstRow", group.firstRow);
    program.set("slabRows", group.slabRows);
    program.set("moleculeCount", group.count);
    program.set("vertexCount", group.vertexCount);
    program.set("firstRecordRow", group.firstRecordRow);
    program.set("topologyBase", group.topologyBase);
    program.texture("positions", 0, state_.position.read(index));
    program.texture("velocities", 1, state_.velocity.read(index));
    if (state_.acceleration) program.texture("accelerations", 2, state_.acceleration.read(index));
    program.texture("records", 3, state_.record.read(index));
    program.texture("constants", 4, state_.constant);
    program.texture("topology", 5, state_.topology);
    if ((kind == PassKind::advect && group.needs.fields) || kind == PassKind::collide)
        program.texture("samples", 6, state_.samples);
    if (kind == PassKind::advect && state_.normal) program.texture("vertexNormals", 7, state_.normal);
    return program;
}

void Simulation::setSprings(const Program& program, const GroupPlan& group, double time, double predictTime) {
    program.set("stiffnessFactor", float(group.stiffness * parameters.stiffness));
    program.set("dampingFactor", float(group.damping * parameters.damping));
    program.set("springTime", float(time));
    program.set("predictTime", float(predictTime));
}

void Simulation::drawState(const GroupPlan& group, const Framebuffer& target) {
    target.bind(0, group.firstRow, std::min(stateWidth, group.count), group.rows);
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Simulation::drawRecords(const GroupPlan& group, const Framebuffer& target) {
    target.bind(0, group.firstRecordRow, std::min(stateWidth, group.count), group.slabRows);
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Simulation::records(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::records, group, index);
    if (group.needs.release) {
        const bool may =
            step.time + 0.5 * step.h >= group.release.after;  // whatever the sum of times was rounded to
        constexpr double never = std::numeric_limits<float>::max();
        const double chance = -std::expm1(-group.release.rate.value_or(0) * parameters.frameTime);
        setSprings(program, group, step.time, 0);
        program.set("releaseForce", float(may ? group.release.force.value_or(never) : never));
        program.set("releaseChance", float(may ? chance : 0));
        program.set("frame", frames_);
    }
    drawRecords(group, state_.target(state_.record.write(index)));
    state_.record.flip(index);
}

void Simulation::normals(const GroupPlan& group, size_t index, const Step& step, bool ahead) {
    const Program& program = prepare(PassKind::normals, group, index);
    const bool halfDrift = ahead && group.solver == SolverKind::leapfrog;
    program.set("aheadTime", float(halfDrift ? step.h / 2 : 0));
    drawState(group, state_.target(state_.normal));
}

void Simulation::restore(const GroupPlan& group, size_t index, const Step& step, bool frameStart) {
    const Program& program = prepare(PassKind::restore, group, index);
    if (group.solver == SolverKind::euler) {
        setSprings(program, group, step.time, 0);
        program.set("kickTime", float(step.h));
        drawState(group, state_.target(state_.velocity.write(index)));
        state_.velocity.flip(index);
        return;
    }
    setSprings(program, group, frameStart ? step.time : step.time + step.h, frameStart ? 0 : step.h / 2);
    program.set("kickTime", float(frameStart ? 0 : step.h / 2));
    const Texture& acceleration = state_.acceleration.write(index);
    drawState(group, frameStart ? state_.target(acceleration)
                                : state_.target(acceleration, &state_.velocity.write(index)));
    state_.acceleration.flip(index);
    if (!frameStart) state_.velocity.flip(index);
}

void Simulation::advect(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::advect, group, index);
    const double across = group.drag.normal * parameters.drag, along = group.drag.tangent * parameters.drag;
    program.set("time", float(step.time));
    program.set("substep", float(step.h));
    program.set("gravity", glm::vec3(parameters.gravity));
    program.set("wind", float(parameters.wind));
    program.set("decay", glm::vec2(decayOf(across, step.h), decayOf(along, step.h)));
    program.set("phi", glm::vec2(phiOf(across, step.h), phiOf(along, step.h)));
    program.set("moveAnchors", int(step.first && group.needs.records));
    drawState(group, state_.target(state_.position.write(index), &state_.velocity.write(index)));
    state_.position.flip(index);
    state_.velocity.flip(index);
}

void Simulation::collide(const GroupPlan& group, size_t index, const Step& step) {
    const Program& program = prepare(PassKind::collide, group, index);
    const bool euler = group.solver == SolverKind::euler;
    program.set("gravity", glm::vec3(parameters.gravity));
    program.set("drift", glm::vec3(step.h, euler ? step.h : step.h / 2, euler ? step.h / 2 : 0));
    drawState(group, state_.target(state_.position.write(index), &state_.velocity.write(index)));
    state_.position.flip(index);
    state_.velocity.flip(index);
}

}  // namespace shoal
