// Meshes of plain shapes, from which new molecules are made: every vertex of theirs is simulated.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace shoal {

struct Shape {
    const char* name;
    const char* material;  // of the material scale, unless another is asked for
    int divisions;         // unless others are asked for
    int mostDivisions;
};

const std::vector<Shape>& shapes();
// Error: unknown, with the nearest.
const Shape& shapeNamed(const std::string& name);

// Of a longest side of 1 m, about the origin, with texture coordinates. `divisions`: of its longest side, 1
// to the shape's most. Error: others.
Mesh shapeMesh(const Shape& shape, int divisions);

}  // namespace shoal
