// A mesh with more vertices in the same shape.
#pragma once

#include "geometry/mesh.h"

namespace shoal {

// Halves the longest edge, and with it the triangles at it, until there are so many welded vertices or more
// [Rivara 1984], or the next edge would make more than `mostTriangles`. What vertices carry goes half and
// half; objects and parts keep their triangles.
void subdivide(Mesh& mesh, size_t weldedVertices, size_t mostTriangles);

}  // namespace shoal
