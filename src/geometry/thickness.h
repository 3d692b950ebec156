// How thick a mesh is at each vertex: tells twigs from branches without names or colours.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// Local thickness in metres of each welded vertex, after the shape diameter function [Shapira 2008]: eight
// rays go inward within 30 degrees of the reversed normal, each to the first surface. Those that enter
// something there started outside and do not count. The least of the middle ray's length and the median is
// taken: exact for slabs, within a few per cent for cylinders, about a diameter at the tip of a twig.
// Infinite where no ray finds a way out (open surfaces) and for vertices that are not `wanted` (one flag
// each; empty: all). O((V + T) log T).
std::vector<double> localThickness(const Mesh& mesh, const std::vector<char>& wanted = {});

}  // namespace shoal
