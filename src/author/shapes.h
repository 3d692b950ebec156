// Meshes of plain shapes, from which new molecules are made: every vertex of theirs is simulated.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "author/from_mesh.h"
#include "geometry/mesh.h"

namespace shoal {

struct Shape {
    const char* name;
    const char* material;  // of the material scale, unless another is asked for
    int divisions;         // unless others are asked for
    int mostDivisions;
    bool swims = false;  // along +Z, with muscles
};

const std::vector<Shape>& shapes();
std::vector<std::string> shapeNames();
// Error: unknown, with the nearest.
const Shape& shapeNamed(std::string_view name);

// Error: the shape's longest side is not divided so; it takes 1 to its most.
void checkDivisions(const Shape& shape, int divisions);
// Returns a mesh about the origin whose longest side is 1 m, with texture coordinates. Error:
// checkDivisions's.
Mesh shapeMesh(const Shape& shape, int divisions);
// Completes what is asked of makeMolecule() for the shape's mesh: all of its vertices, no skin, and where
// nothing is said a size of 0.2 m and its material.
FromMesh ofShape(const Shape& shape, const Mesh& mesh, FromMesh asked);

}  // namespace shoal
