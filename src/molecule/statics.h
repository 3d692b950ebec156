// A molecule under loads, linearised about its rest shape as analysis.h does: what it is bent to, the
// frequencies of motions of a given kind, and the load under which it buckles.
//
// Where nothing holds the whole, loads that would move it as a whole are left out and so are such motions.
// Units: N, m, rad/s. Each throws an Error where no vertex moves, above 300 vertices, and where some motion
// has no stiffness.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

using VertexVectors = std::vector<glm::dvec3>;  // one entry a vertex

// K u = f. `pinned`: pins hold.
VertexVectors displacements(const Molecule& molecule, bool pinned, const VertexVectors& loads);

// For each shape, the frequency of the motion like it: of those that have at least half as large a share of
// it as any, with the masses as weights, the slowest.
std::vector<double> frequenciesLike(const Molecule& molecule, bool pinned,
                                    const std::vector<VertexVectors>& shapes);

// The least factor of the loads, above 0, at which K + factor S is singular; infinite where there is none.
// S = sum of t / l (I - n n^T) over the springs, with t their tension under the loads.
double bucklingFactor(const Molecule& molecule, const VertexVectors& loads);

}  // namespace shoal
