// Warnings about molecules that are valid but probably not what was meant.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

// Located where the molecule was read from a file. Warns of: loose vertices, separate parts, motions that no
// spring resists, flipped and zero-area triangles, vertices that are not drawn, pins that do not hold, masses
// that differ by more than 1e4, and rest lengths far from the drawn distance.
// The molecule must be valid (see molecule_file.h).
std::vector<Warning> check(const Molecule& molecule);

}  // namespace shoal
