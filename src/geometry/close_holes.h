// A mesh without its small holes.
#pragma once

#include "geometry/mesh.h"

namespace shoal {

// Closes holes by fans about their middles: those whose border is one simple loop and whose fan has at most
// this share of the mesh's area. Returns how many.
int closeHoles(Mesh& mesh, double mostOfArea);

}  // namespace shoal
