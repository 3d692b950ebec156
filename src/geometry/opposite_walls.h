// The triangles of a mesh that lie on one another. For doubled_walls.cpp alone.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// Returns a flag for each triangle, set for those on the corners of others that go. Of those that face one
// way the first stays. Of two that face opposite ways both go where they are a wall between solids that
// touch, as in voxels and joined tetrahedra: then the solids are one body. One stays where they are a sheet
// with two faces: the border of a sheet is free somewhere, that of a wall lies on other triangles all along.
// Two coplanar triangles of a quad may lie on two others that are cut along the other diagonal.
std::vector<char> coincidentTriangles(const Mesh& mesh);

}  // namespace shoal
