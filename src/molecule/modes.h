// The motions that a molecule's springs allow, one by one: to be looked at, and to see what is soft.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

struct Mode {
    double frequency = 0;           // rad/s; 0: no spring resists it to first order
    std::vector<glm::dvec3> shape;  // of every vertex: how it moves; the largest has length 1
};

// The slowest ones first, at most `most`, without the rigid motions; linearised as in molecule/analysis.h.
// Empty above 300 vertices. `pinned`: pins hold. The molecule must be valid (see molecule_file.h).
std::vector<Mode> modesOf(const Molecule& molecule, bool pinned, size_t most);

}  // namespace shoal
