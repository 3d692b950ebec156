// Signed distance and normal of a scene's colliders in double precision: the same definitions as
// shaders/step/surfaces.glsl.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal::reference {

struct Surface {
    glm::dvec3 normal{0, 1, 0};  // unit, towards the free side
    double distance = 1e30;      // m, negative inside; 1e30 where there is nothing
    bool exists() const { return distance < 1e20; }
};

// Returns the drawn surface at x. A height field's distance is (y - height) times the normal's y: exact where
// it is flat.
Surface surfaceAt(const ColliderShape& shape, const glm::dvec3& x);

// Facts about the surface of a kind.
struct SurfaceFacts {
    double feature = 1e30;
    double top = 1e30;    // m: nothing is above this height
    double steepest = 1;  // how much the distance changes in a metre at most; 0: not known
    bool exact = true;
};

// The surfaces that vertices rest on, each its collider's thickness off the drawn one.
class RestSurfaces {
  public:
    // Borrows the colliders.
    explicit RestSurfaces(const std::vector<Collider>& colliders);

    size_t count() const { return colliders_->size(); }
    const Collider& collider(size_t i) const { return (*colliders_)[i]; }
    Surface surfaceOf(size_t i, const glm::dvec3& x) const;
    // As surfaceOf(), for a vertex that is held: the surface goes on a little past the border of a height
    // field, so that the motion is smooth until the vertex leaves it.
    Surface under(size_t i, const glm::dvec3& x) const;

    // m: a way no longer than this cannot pass through the collider unnoticed between its ends.
    double feature(size_t i) const { return facts_[i].feature; }
    // True when no point within `reach` m of x is inside.
    bool clear(size_t i, const glm::dvec3& x, double reach) const;
    // True when the normal is the gradient of the distance, of length 1: of all but height and distance
    // fields.
    bool exact(size_t i) const { return facts_[i].exact; }

    // How a vertex that is held on the surface and moves at v follows it: `shift`, the rate at which it is
    // shifted along the normal to stay there, in m/s, and `turning`, v . dn/dt, in m/s^2.
    struct Following {
        double shift = 0, turning = 0;
    };
    Following following(size_t i, const Surface& surface, const glm::dvec3& x, const glm::dvec3& v) const;

  private:
    double shiftAlong(size_t i, const Surface& surface, const glm::dvec3& x, const glm::dvec3& v) const;

    const std::vector<Collider>* colliders_;
    std::vector<SurfaceFacts> facts_;
};

}  // namespace shoal::reference
