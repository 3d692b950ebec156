// Colliders made in code for the tests of contact.
#pragma once

#include <utility>

#include "scene/collider_kinds.h"

namespace shoal::test {

inline Collider collider(ColliderShape shape, double restitution, double friction, double thickness) {
    Collider out;
    out.shape = std::move(shape);
    out.restitution = restitution;
    out.friction = friction;
    out.thickness = thickness;
    return out;
}

inline PlaneCollider plane(const glm::dvec3& normal) {
    PlaneCollider out;
    out.normal = normal;
    return out;
}

}  // namespace shoal::test
