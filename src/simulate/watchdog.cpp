#include "simulate/watchdog.h"

#include <cmath>
#include <limits>

#include "compile/choose_solver.h"
#include "compile/pack.h"
#include "compile/plan.h"
#include "simulate/simulation.h"

namespace shoal {

namespace {

// As the shaders see it: the square must be finite as well.
bool finiteSquare(const glm::vec3& value) {
    return std::isfinite(glm::dot(value, value));
}

glm::vec3 anchorShift(const glm::vec3& p) {
    if (std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1) return glm::vec3(0);
    return latticePoint(p);
}

// In world coordinates.
glm::dvec3 placeOf(const GroupState& state, size_t molecule, size_t vertex) {
    return glm::dvec3(state.anchors[molecule]) + glm::dvec3(state.positions[vertex]);
}

bool wasHeld(const GroupPlan& group, const GroupState& state, size_t molecule) {
    for (size_t v = 0; v < group.pinned.size(); ++v) {
        if (!group.pinned[v]) continue;
        const size_t i = molecule * group.pinned.size() + v;
        if (state.velocities[i] != glm::vec3(0) ||
            placeOf(state, molecule, i) != placeOf(group.start, molecule, i))
            return false;
    }
    return true;
}

std::string cause(const Plan& plan, const Alarm& alarm) {
    if (alarm.cutShort)
        return concat("Mesa's rasteriser leaves off after ", gpu::mostSoftwareTurns,
                      " turns of loops for a molecule and frame, which many colliders, vertices and substeps "
                      "need. Try fewer --substeps at a higher frameRate, or fewer colliders");
    std::string hasty = hastyForce(plan.forces, plan.groups[alarm.group], 1 / plan.frameRate / plan.substeps);
    constexpr const char* remedy = ". Try more --substeps, another --solver, or smaller numbers";
    if (!hasty.empty()) return hasty + remedy;
    if (!alarm.finite)
        return concat("the step is too long for something here, or a force is beyond what a float holds",
                      remedy);
    return concat("the limit is ", runawaySpeed,
                  " m/s: the step is too long for something here, or a field, a ",
                  "force, drag or start velocity is too large", remedy);
}

std::string describe(const Plan& plan, const Alarm& alarm) {
    return concat("stopped at frame ", alarm.frame, ", ", alarm.time, " s: group \"",
                  plan.groups[alarm.group].name, "\", molecule ", alarm.molecule, ", vertex ", alarm.vertex,
                  alarm.cutShort ? " was cut short"
                  : alarm.finite ? concat(" moves with ", alarm.speed, " m/s")
                                 : " is not finite",
                  "; ", cause(plan, alarm));
}

}  // namespace

std::string fastestDefine() {
    return concat("FASTEST_SQUARED ", runawaySpeed * runawaySpeed);
}

RunawayQuery::RunawayQuery(gpu::Traffic& traffic) : traffic_(&traffic) {
    GLuint id = 0;
    glGenQueries(1, &id);
    query_ = gpu::Handle<gpu::deleteQuery>(id);
}

RunawayQuery::Asking::Asking(RunawayQuery& query) {
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBeginQuery(GL_ANY_SAMPLES_PASSED, query.query_.id());
    query.asked_ = true;
}

RunawayQuery::Asking::~Asking() {
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

bool RunawayQuery::raised() const {
    if (!asked_) return false;
    GLuint raised = GL_FALSE;
    glGetQueryObjectuiv(query_.id(), GL_QUERY_RESULT, &raised);
    traffic_->countReadBack(gpu::Traffic::Kind::control, sizeof raised);
    return raised != GL_FALSE;
}

Alarm findAlarm(const SavedState& saved) {
    Alarm worst;
    worst.time = saved.time;
    worst.frame = saved.frames;
    for (size_t g = 0; g < saved.groups.size(); ++g) {
        const GroupState& state = saved.groups[g];
        const size_t vertices = state.positions.size() / state.anchors.size();
        for (size_t i = 0; i < state.positions.size(); ++i) {
            if (!state.lives.empty() && state.lives[i / vertices].y <= 0) continue;  // a free place
            const bool finite = finiteSquare(state.positions[i]) && finiteSquare(state.velocities[i]);
            const double speed = glm::length(glm::dvec3(state.velocities[i]));
            const bool cutShort = state.positions[i] == glm::vec3(std::numeric_limits<float>::infinity());
            // what was cut short is the cause of what is not finite beside it
            if (!cutShort && (!worst.finite || (finite && !(speed > worst.speed)))) continue;
            worst.group = g;
            worst.molecule = int(i / vertices);
            worst.vertex = int(i % vertices);
            worst.speed = speed;
            worst.finite = finite;
            worst.cutShort = cutShort;
            if (cutShort) return worst;
        }
    }
    return worst;
}

bool runsAway(const Alarm& alarm) {
    return !alarm.finite || alarm.speed >= runawaySpeed;
}

Runaway::Runaway(const Plan& plan, const Alarm& alarm)
    : Error(plan.groups[alarm.group].location, describe(plan, alarm)), alarm_(alarm) {}

void undoRecords(const GroupPlan& group, GroupState& state) {
    const size_t vertices = size_t(group.vertexCount);
    for (size_t m = 0; m < state.anchors.size(); ++m) {
        if (group.needs.records) state.anchors[m] -= anchorShift(state.positions[m * vertices]);
        if (state.released[m] && wasHeld(group, state, m)) state.released[m] = 0;
    }
}

}  // namespace shoal
