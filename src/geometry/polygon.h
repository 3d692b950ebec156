// Polygons cut into triangles. For the readers of models alone.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// Returns count - 2 triangles of a polygon's corners, numbers in `corners`, that face as it does; none of
// fewer than three. Ears are cut off as they follow one another, so that a convex polygon becomes a fan about
// its first corner, and a concave one stays as it is ([Meisters 1975]). One that crosses itself is cut
// somehow.
std::vector<glm::ivec3> cutPolygon(const std::vector<glm::dvec3>& corners);

}  // namespace shoal
