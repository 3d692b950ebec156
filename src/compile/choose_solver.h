// Which solver a group takes, and whether its substep is one that the solver can take. Pure.
#pragma once

#include "compile/plan.h"

namespace shoal {

// Fills the group's solver, the reason for it, highestFrequency and stableStep. Where the scene names none:
//
//   leapfrog        without springs, or while the substep holds leapfrog stable for every shape that the
//                   molecule may take (the weighted graph Laplacian's bound, molecule/analysis.h) together
//                   with the forces
//   leapfrog        too where only leapfrog is sure to run: a lane does not hold the molecule, or a CPU
//                   rasteriser would refuse to compile bdf2-xpbd for it (compile/lanes.h), and the substep
//                   holds leapfrog stable at rest
//   bdf2-newton     where a lane does not hold the molecule otherwise
//   bdf2-xpbd       otherwise, or
//   bdf2-corotated  where sweeps strain the springs and it does not (compile/strain.h)
//
// The choice is the same on every device. `plan`: its fields and colliders are counted; takes the warnings.
//
// Error (located at the solver, else at the group): the substep is beyond what the named solver holds stable,
// or zero, or drag is beyond what it takes; says how many substeps would do. bdf2-newton is named for stiff
// bodies that a lane holds, beside colliders.
// Warnings: an implicit solver strains the springs by 0.02 more than 16 times the substeps of bdf2-xpbd do,
// with what would do instead; bdf2-newton takes larger stiff bodies, beside colliders; the substep is too
// long for a force, which no solver takes implicitly.
void chooseSolver(const Scene& scene, const Group& group, Plan& plan, GroupPlan& out);

// Whether every deformation of the group's molecules is over within a step (s), so that contact treats them
// as bodies: GroupPlan::rigid, for another step than the plan's.
bool isRigidWithin(const GroupPlan& group, double step);

// "the force \"drain\" (vortexLine) turns \"dust\" by up to 1000 rad/s: ..." where the substep (s) is too
// long for it; else empty.
std::string hastyForce(const std::vector<Force>& forces, const GroupPlan& group, double step);

}  // namespace shoal
