// How far an implicit solver lets the springs of a molecule strain. Sweeps pass a force on by one spring at a
// time and begin each stage without any: where many springs carry one load, or where damping outweighs all
// else, they end far from the stage's solution, and so do quasi-Newton steps with the matrix of a shape that
// the molecule no longer has. Newton steps with its own matrix do not (bdf2-newton).
//
// One molecule is run on the CPU for 0.5 s, at most 1000 substeps, from its rest shape, in spin and under
// gravity, without drag, fields, forces, muscles and contact: in double precision, with the factors of
// bdf2-corotated as the floats that a GPU has.
#pragma once

#include "molecule/molecule.h"
#include "scene/solver.h"

namespace shoal {

struct StrainRun {
    SolverKind solver = SolverKind::bdf2Xpbd;      // an implicit one
    double substep = 0;                            // s
    int finer = 1;                                 // so many steps take the place of each
    double scale = 1, stiffness = 1, damping = 1;  // factors on lengths and on every spring
    bool held = true;                              // pinned vertices hold
    glm::dvec3 gravity{0};                         // m/s^2, in the molecule's axes
    glm::dvec3 spin{0};                            // rad/s, about its origin
};

// The largest |length / rest length - 1| of any spring at any time of the run.
double largestStrain(const Molecule& molecule, const StrainRun& run);

}  // namespace shoal
