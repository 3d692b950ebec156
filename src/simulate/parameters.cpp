#include "simulate/parameters.h"

#include "compile/plan.h"

namespace shoal {

Parameters parametersOf(const Plan& plan) {
    Parameters out;
    out.gravity = plan.gravity;
    out.substeps = plan.substeps;
    out.frameTime = 1 / plan.frameRate;
    return out;
}

}  // namespace shoal
