// The arrays of a plan: start state, records and topology, in the layout of compile/plan.h.
#pragma once

#include "compile/plan.h"

namespace shoal {

// Fills the group's rows of positions, velocities, records and constants, which are large enough.
void packState(const Scene& scene, const GroupPlan& group, Plan& plan);
// Appends the molecule's tables and returns their base index.
int packTopology(const Molecule& molecule, bool held, std::vector<glm::vec4>& topology);

}  // namespace shoal
