// How thick a mesh is at each vertex: tells twigs from branches without names or colours.
#pragma once

#include <vector>

#include "scene/mesh.h"

namespace shoal {

// Local thickness in metres of each welded vertex, after the shape diameter function (Shapira, Shamir,
// Cohen-Or 2008): rays go inward in a cone of 30 degrees around the reversed normal, each as far as the
// first surface that it leaves through. The least of the middle ray's length and the median is taken:
// exact for slabs, within a few per cent for cylinders, about a diameter near the tip of a twig.
// Infinite where rays find no way out (open surfaces). O((V + T) log T).
std::vector<double> localThickness(const Mesh& mesh);

}  // namespace shoal
