// The gaps that spheres on a molecule leave open in its triangles.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

struct Gap {
    double radius = 0;  // m, of the largest sphere that passes through a triangle between the spheres
    int triangle = -1;  // in which; -1: none is open
};

// Spheres of one radius, m, of which the first are at the vertices.
Gap largestGap(const Molecule& molecule, const std::vector<glm::dvec3>& spheres, double radius);

// Rest positions of a molecule's vertices and, where asked, of its triangles' middles behind them.
std::vector<glm::dvec3> restSpheres(const Molecule& molecule, bool triangles);

// The radius, m, with which spheres at the vertices, and where asked at the triangles' middles, let no like
// one through: half of the largest gap. Of a point: half of its drawn size; without triangles: half of the
// furthest that a vertex is from its nearest.
double closingRadius(const Molecule& molecule, bool triangles);

}  // namespace shoal
