// How the volume of a body or the area of a sheet, and its mass with it, is spread over the vertices of a
// coarse mesh and in space. For from_mesh.cpp alone.
#pragma once

#include <vector>

#include "author/coarse.h"

namespace shoal {

struct MassSpread {
    std::vector<double> shares;  // of each coarse vertex; they add up to 1
    glm::dvec3 axis{0, 0, 1};    // unit, along which it is spread widest
    double gyration = 0;         // m, along the thinnest direction
};

MassSpread spreadOfBody(const CoarseMesh& coarse, const Inside& inside);
// `coarse`: with its map from the mesh.
MassSpread spreadOfSheet(const Mesh& mesh, const CoarseMesh& coarse);

}  // namespace shoal
