#include "simulate/parameters.h"

#include <algorithm>

#include "compile/plan.h"

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

}  // namespace shoal
