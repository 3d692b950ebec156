// Whether a mesh encloses a volume, and where it does not.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// An edge is sound when as many triangles pass it one way as the other: then every point off the surface has
// a whole winding number, also where shells touch, overlap or share edges. Corners are compared after
// welding.
struct SurfaceReport {
    size_t triangles = 0, degenerate = 0;  // degenerate: two corners in one place; they are left out
    size_t borders = 0;                    // edges of one triangle
    size_t turned = 0;                     // edges whose triangles disagree about the outside
    size_t branching = 0;                  // edges of three or more triangles that do not cancel
    glm::dvec3 where{0};                   // the middle of the first unsound edge
    std::string object;                    // whose triangle it is
    double area = 0, volume = 0;           // m^2; m^3, negative when turned inside out

    size_t unsound() const { return borders + turned + branching; }
    // On the average thinner than a millionth of its size, a surface encloses nothing: a sheet with two
    // faces.
    bool hollow = false;
    bool closed() const { return unsound() == 0 && !hollow; }
};

SurfaceReport examineSurface(const Mesh& mesh);

// "3 border edges, the first at (0.1, 2, -1) of \"rim\"": why the surface is not closed.
std::string whyOpen(const SurfaceReport& report);

}  // namespace shoal
