// A mesh as a molecule is made of it. For from_mesh.cpp alone.
#pragma once

#include "author/from_mesh.h"

namespace shoal {

// Returns a mesh in metres, turned and placed as the options say, without vertices that no triangle has. One
// that lies at map coordinates comes to the origin, of which a note tells: single precision would not hold
// its shape there. Error: it has no size, or reaches too far.
Mesh placed(const Mesh& source, const FromMesh& options);

// Returns a mesh without the walls that are there twice: what a molecule is made of, while its skin keeps
// all.
Mesh withoutDoubledWalls(Mesh mesh);

}  // namespace shoal
