// The triangles that a collider is drawn with.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "scene/known_colliders.h"

namespace shoal {

struct ColliderMesh {
    glm::dvec3 origin{0};                       // m
    std::vector<glm::vec3> positions, normals;  // m, relative to the origin; unit
    std::vector<uint32_t> corners;              // three a triangle, anticlockwise seen from outside
};

// In the frame in which the shape is given. Of a plane a disc of radius 1 around 0. Height and distance
// fields have no triangles: they show as their models.
ColliderMesh colliderMesh(const Collider& collider);

// The part of a plane that is drawn for an eye: a disc around its foot, with a radius in m.
struct PlaneDisc {
    glm::dvec3 foot{0};
    double radius = 0;
};
PlaneDisc seenOf(const PlaneCollider& plane, const glm::dvec3& eye);

// Two unit directions across a unit normal; x and z for one that points up.
std::pair<glm::dvec3, glm::dvec3> tangentsOf(const glm::dvec3& normal);

}  // namespace shoal
