// Tetrahedra of a body-centred cubic lattice that fill a volume ([Molino 2003]: the lattice, not its
// refinement).
#pragma once

#include <array>
#include <vector>

#include "author/coarse.h"
#include "author/inside.h"

namespace shoal {

struct Lattice {
    CoarseMesh surface;                     // its vertices, and the faces of one tetrahedron only
    std::vector<std::array<int, 4>> cells;  // tetrahedra
};

// As fine as `vertices` allow: of all lattices over the box the one that fills most with at most so many
// vertices. Error: the shape is too thin for any.
Lattice latticeIn(const Mesh& mesh, const Inside& inside, int vertices);

}  // namespace shoal
