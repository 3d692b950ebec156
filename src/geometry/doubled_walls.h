// The walls of a mesh that are there twice, or inside it, and add nothing to its shape.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// One flag a triangle. Set are those on the corners of an earlier one, whichever way they face; those of open
// pieces that lie on another one, everywhere nearer to it than three thousandths of its size; and those of pieces
// within a closed one, unless they make it hollow by facing inwards. A piece is what hangs together by welded
// vertices.
std::vector<char> doubledWalls(const Mesh& mesh);

}  // namespace shoal
