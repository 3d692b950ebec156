// Where spheres lie on a molecule, and the gaps that they leave open in its triangles.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

struct Gap {
    double radius = 0;  // m, of the largest sphere that passes through a triangle between the spheres
    int triangle = -1;  // in which; -1: none is open
};

// A point of a triangle: the mean of its corners, weighted by `parts`, of which none is negative.
struct TrianglePoint {
    glm::ivec3 corners{0}, parts{0};
};

// The middle of each triangle.
std::vector<TrianglePoint> middlePoints(const Molecule& molecule);

// Points of triangles whose spheres close a molecule to whatever has spheres of the same radius, m, those at
// its vertices included: along edges they touch, so that no other edge passes between two of them, and over a
// triangle they leave no gap for a like sphere.
std::vector<TrianglePoint> closingPoints(const Molecule& molecule, double radius);

// m: closingPoints closes a molecule with this radius, and not with any smaller one.
double leastClosingRadius(const Molecule& molecule);

// Spheres of one radius, m, of which the first are at the vertices.
Gap largestGap(const Molecule& molecule, const std::vector<glm::dvec3>& spheres, double radius);

// Rest positions of a molecule's vertices and, behind them, of points of its triangles.
std::vector<glm::dvec3> restSpheres(const Molecule& molecule, const std::vector<TrianglePoint>& points);

// The radius, m, with which spheres at the vertices, and where asked at the triangles' middles, let no like
// one through: half of the largest gap. Of a point: half of its drawn size; without triangles: half of the
// furthest that a vertex is from its nearest.
double closingRadius(const Molecule& molecule, bool triangles);

}  // namespace shoal
