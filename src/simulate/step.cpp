#include "simulate/step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal {

Parameters parametersOf(const Plan& plan) {
    Parameters out;
    out.gravity = plan.gravity;
    for (const Force& force : plan.forces)
        out.forces.push_back({.on = !force.mouse, .factor = 1, .position = {}});
    out.substeps = plan.substeps;
    out.frameTime = 1 / plan.frameRate;
    return out;
}

bool jumps(const Parameters& from, const Parameters& to) {
    const auto same = [](const ForceControl& a, const ForceControl& b) {
        return a.on == b.on && a.factor == b.factor && a.position.has_value() == b.position.has_value();
    };
    return from.gravity != to.gravity || from.wind != to.wind || from.drag != to.drag ||
           from.stiffness != to.stiffness || from.damping != to.damping || from.fields != to.fields ||
           !std::equal(from.forces.begin(), from.forces.end(), to.forces.begin(), to.forces.end(), same);
}

Frame pieceOf(const Frame& frame, int i, int steps) {
    if (steps == 1) return frame;
    const int substeps = frame.parameters.substeps;
    Frame out = frame;
    // as evenly as can be
    const int before = substeps * i / steps, after = substeps * (i + 1) / steps;
    out.time = frame.time + frame.h * before;
    out.end = i + 1 == steps ? frame.end : frame.time + frame.h * after;
    out.number = frame.number * steps + i;  // random numbers differ
    out.parameters.substeps = after - before;
    out.parameters.frameTime = frame.h * out.parameters.substeps;
    out.restarts = frame.restarts && i == 0;
    return out;
}

DragCoefficients dragCoefficients(const GroupPlan& group, const Parameters& parameters, double h) {
    const double across = group.drag.normal * parameters.drag, along = group.drag.tangent * parameters.drag;
    const bool slips = group.solver == SolverKind::leapfrog && std::min(across, along) * h > slipFrom;
    const auto decay = [&](double gamma) {
        return slips ? gamma * h / (1 + gamma * h) : -std::expm1(-gamma * h);
    };
    const auto phi = [&](double gamma) { return std::abs(gamma * h) < 1e-12 ? h : decay(gamma) / gamma; };
    // its series where the difference would be left with rounding
    const auto bend = [&](double gamma) {
        const double x = gamma * h;
        return std::abs(x) < 1e-3 ? h * h * (0.5 - x / 6 + x * x / 24) : (h - phi(gamma)) / gamma;
    };
    return {glm::vec2(decay(across), decay(along)), glm::vec2(phi(across), phi(along)), slips,
            glm::vec2(bend(across), bend(along))};
}

StageCoefficients stageCoefficients(const GroupPlan& group, const Parameters& parameters, double h) {
    const double eta = 2 * h / 3;
    const auto phi = [eta](double gamma) { return eta / (1 + gamma * eta); };
    const double across = group.drag.normal * parameters.drag, along = group.drag.tangent * parameters.drag;
    return {
        float(eta),
        {glm::vec2(across * phi(across), along * phi(along)), glm::vec2(phi(across), phi(along)), false, {}}};
}

ReleaseLimits releaseLimits(const GroupPlan& group, const Frame& frame) {
    // whatever the sum of times was rounded to
    const bool may = frame.time + 0.5 * frame.h >= group.release.after;
    constexpr double never = std::numeric_limits<float>::max();
    const double chance = -std::expm1(-group.release.rate.value_or(0) * frame.parameters.frameTime);
    return {float(may ? group.release.force.value_or(never) : never), float(may ? chance : 0)};
}

std::vector<glm::vec4> fieldParameters(const Plan& plan, const Frame& frame) {
    std::vector<glm::vec4> out = plan.fields.parameters;
    const std::vector<double>& factors = frame.parameters.fields;
    for (size_t i = 0; i < std::min(factors.size(), plan.fields.weights.size()); ++i)
        out[plan.fields.weights[i]].w *= float(factors[i]);
    setClocks(out, plan.fields.clocks, frame.time);
    return out;
}

std::vector<glm::vec4> colliderParameters(const Plan& plan, const GroupPlan& group, const Frame& frame) {
    std::vector<glm::vec4> out = group.colliderParameters;
    setPoses(out, plan.colliders.moving, plan.colliders.fastestSlot, frame.time, frame.parameters.frameTime);
    return out;
}

glm::vec3 driftOf(SolverKind solver, double h, bool slips) {
    // the others of order 1 drift by the velocity that the step ends with
    const bool first = shoal::solver(solver).order == 1 || slips;
    return glm::vec3(h, first ? h : h / 2, first ? h / 2 : 0);
}

}  // namespace shoal
