// Computes the properties of colliders on which their generated GLSL depends, beside its parameters.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace shoal {

// Whether a vertex could cross it within a substep, so that it is looked for along the way. Planes and height
// fields are solid all the way down.
bool isSwept(const ColliderShape& shape);

// m: no point of its rest surface is further from the origin of the frame in which its shape is given. Of
// swept ones.
double reachOf(const Collider& collider);

// A point of the frame in which the shape is given that is on it or near it.
glm::dvec3 placeOf(const ColliderShape& shape);

// For shaders/physics/solid.glsl.
struct CapsuleAxis {
    glm::dvec3 along{0};
    double perLength = 0;  // 1/m^2; 0 where the ends coincide
    glm::dvec3 aside{0, 1, 0};
};
CapsuleAxis axisOf(const CapsuleCollider& capsule);

}  // namespace shoal
