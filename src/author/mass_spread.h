// How the volume of a body or the area of a sheet, and its mass with it, is spread over the vertices of a
// coarse mesh and in space. For this room.
#pragma once

#include <vector>

#include "author/coarse.h"

namespace shoal {

struct MassSpread {
    std::vector<double> shares;  // of each coarse vertex; they add up to 1
    glm::dvec3 axis{0, 0, 1};    // unit, along which it is spread widest
    glm::dvec3 thin{0, 1, 0};    // unit, along which it is spread least
    double gyration = 0;         // m, along that
};

// Of a sheet by itself, without shares. One that is as wide as it is long lies along an axis of the file.
MassSpread spreadOfSheet(const Mesh& mesh);
MassSpread spreadOfBody(const CoarseMesh& coarse, const Inside& inside);
// `coarse`: with its map from the mesh.
MassSpread spreadOfSheet(const Mesh& mesh, const CoarseMesh& coarse);

double extentAlong(const Mesh& mesh, const glm::dvec3& axis);  // m

}  // namespace shoal
