#include "simulate/parameters.h"

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

}  // namespace shoal
