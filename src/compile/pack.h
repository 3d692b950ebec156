// The arrays of a plan: the start state and the table of the topology.
#pragma once

#include "compile/plan.h"

namespace shoal {

// Fills the group's start state and constants: every molecule where it is placed.
void packStart(const Scene& scene, GroupPlan& group);
// Appends the molecule's tables and returns their base index.
int packTopology(const Molecule& molecule, bool held, std::vector<glm::vec4>& topology);

}  // namespace shoal
