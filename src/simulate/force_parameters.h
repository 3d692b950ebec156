// The numbers of the forces on a group in a frame, for the text of compile/generate_forces.h. A path and a
// change by hand are taken in the middle of the frame, and hold over it: an error of second order in the
// frame. (Solvers with history ask for forces at the ends of their substeps, and get the middle of those.)
//
// Parameters of one, from its slot:
//   attract      position, strength        radius, most
//   vortexLine   position, pull            axis, turn         core, radius
//   thrust       exp(rate h), exp(rate h/2), limit, rate
// and last the sum of the winds. The strengths of what is switched off are 0.
#pragma once

#include "simulate/step.h"

namespace shoal {

std::vector<glm::vec4> forceParameters(const Plan& plan, const GroupPlan& group, const Frame& frame);

}  // namespace shoal
