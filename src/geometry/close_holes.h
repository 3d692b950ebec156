// A mesh without its small holes.
#pragma once

#include "geometry/mesh.h"

namespace shoal {

// Closes holes by fans about their middles: those whose border is one simple loop and whose fan has at most
// this area, m^2. Returns how many.
int closeHoles(Mesh& mesh, double mostArea);

}  // namespace shoal
