// The walls of a mesh that are there twice, or inside it, and add nothing to its shape.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// Returns a flag for each triangle, set for those that add nothing to the shape: triangles on the corners of
// others, of a wall between two solids on both sides (opposite_walls.h); those of an open piece that lies on
// another open piece, everywhere nearer to it than three thousandths of that one's size; and those of a piece
// inside a closed one, unless they make it hollow by facing inwards. A piece is a set of triangles that
// welded vertices connect.
std::vector<char> doubledWalls(const Mesh& mesh);

}  // namespace shoal
