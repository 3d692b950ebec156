// The point of a mesh that is nearest to another, and how thick the mesh is there. Embree's hierarchy [Wald
// 2014] finds the triangles, in single precision and generously; distances to them are ours, in double.
#pragma once

#include <limits>
#include <memory>

#include "geometry/mesh.h"

namespace shoal {

struct ClosestPoint {
    double distance = std::numeric_limits<double>::infinity();  // m, at least 0
    glm::dvec3 point{0};
    int triangle = -1;
    bool front = true;  // seen from the side that the triangle's normal points to
};

class ClosestPoints {
  public:
    // Borrows the mesh, of which it takes the welded vertices. Error: Embree has no memory for it.
    explicit ClosestPoints(const Mesh& mesh);
    ~ClosestPoints();
    ClosestPoints(const ClosestPoints&) = delete;
    ClosestPoints& operator=(const ClosestPoints&) = delete;

    // May be called from several threads. Nothing (triangle -1) is found further than `within`. Where several
    // triangles are as near, `front` is of the one that faces the point most, which is right at edges and at
    // all but saddle-like corners. `guess`: a triangle that may be near, which makes it faster.
    ClosestPoint find(const glm::dvec3& x, double within = std::numeric_limits<double>::infinity(),
                      int guess = -1) const;

    // Returns the thickness of a closed mesh, m: the distance from a point of the surface along the unit
    // `direction`, which leads inside, to where it leaves all shells again, through a triangle that faces
    // away by less than 45 degrees. Infinite where there is no such place, or where the point lies inside
    // another shell.
    double across(const glm::dvec3& from, const glm::dvec3& direction) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace shoal
