#include "simulate/step.h"

#include <cmath>
#include <limits>

namespace shoal {

DragCoefficients dragCoefficients(const GroupPlan& group, const Parameters& parameters, double h) {
    const double across = group.drag.normal * parameters.drag, along = group.drag.tangent * parameters.drag;
    const bool slips = std::min(across, along) * h > slipFrom;
    const auto decay = [&](double gamma) {
        return slips ? gamma * h / (1 + gamma * h) : -std::expm1(-gamma * h);
    };
    const auto phi = [&](double gamma) { return std::abs(gamma * h) < 1e-12 ? h : decay(gamma) / gamma; };
    return {glm::vec2(decay(across), decay(along)), glm::vec2(phi(across), phi(along)), slips};
}

StageCoefficients stageCoefficients(const GroupPlan& group, const Parameters& parameters, double h) {
    const double eta = 2 * h / 3;
    const auto phi = [eta](double gamma) { return eta / (1 + gamma * eta); };
    const double across = group.drag.normal * parameters.drag, along = group.drag.tangent * parameters.drag;
    return {float(eta),
            {glm::vec2(across * phi(across), along * phi(along)), glm::vec2(phi(across), phi(along))}};
}

ReleaseLimits releaseLimits(const GroupPlan& group, const Frame& frame) {
    // whatever the sum of times was rounded to
    const bool may = frame.time + 0.5 * frame.h >= group.release.after;
    constexpr double never = std::numeric_limits<float>::max();
    const double chance = -std::expm1(-group.release.rate.value_or(0) * frame.parameters.frameTime);
    return {float(may ? group.release.force.value_or(never) : never), float(may ? chance : 0)};
}

glm::vec3 driftOf(SolverKind solver, double h, bool slips) {
    // the others of order 1 drift by the velocity that the step ends with
    const bool first = shoal::solver(solver).order == 1 || (slips && solver == SolverKind::leapfrog);
    return glm::vec3(h, first ? h : h / 2, first ? h / 2 : 0);
}

}  // namespace shoal
