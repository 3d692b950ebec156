// The kinds of colliders' shapes: those of scene/known_colliders.h, and those that no other room names. Each
// has its description for files, the call of its function in shaders/physics/solid.glsl, or in
// shaders/step/surfaces.glsl where it reads samples, its triangles (scene/collider_mesh.cpp) and its
// double-precision twin (reference/colliders.cpp). docs/adding-a-force.md says how to add one. SI units. Of a
// shape that is solid all the way down or has no end the functions say nothing:
//
// - reach: how far its points are at most from a point of the frame in which it is given. A vertex could
//   cross what has one within a substep, and it is looked for along the vertex's way.
// - support: how far it goes along a unit vector, from the origin: the largest dot product with one of its
//   points.
// - girth: the radius of the widest part that has to get through a gap when it does.
// - cost: of a look for contact with it.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/known_colliders.h"

namespace shoal {

struct SphereCollider {
    glm::dvec3 center{0};
    double radius = 1;  // m
    std::optional<double> reach(const glm::dvec3& point) const {
        return glm::distance(center, point) + radius;
    }
    std::optional<double> support(const glm::dvec3& direction) const {
        return glm::dot(center, direction) + radius;
    }
    std::optional<double> girth() const { return radius; }
    static constexpr ReadingCost cost{10};
    GlslCall call() const;
};

struct BoxCollider {
    glm::dvec3 center{0};
    glm::dvec3 size{1};  // m, whole edges
    glm::dquat rotation{1, 0, 0, 0};
    std::optional<double> reach(const glm::dvec3& point) const {
        return glm::distance(center, point) + glm::length(size) / 2;
    }
    std::optional<double> support(const glm::dvec3& direction) const {
        const glm::dvec3 own = glm::inverse(rotation) * direction;
        return glm::dot(center, direction) + 0.5 * glm::dot(glm::abs(own), size);
    }
    std::optional<double> girth() const {
        const double longest = std::max({size.x, size.y, size.z});
        return 0.5 * std::sqrt(glm::dot(size, size) - longest * longest);
    }
    static constexpr ReadingCost cost{45};
    GlslCall call() const;
};

// All within `radius` of the line between two points; a sphere where they coincide.
struct CapsuleCollider {
    glm::dvec3 from{0}, to{0};
    double radius = 1;  // m
    std::optional<double> reach(const glm::dvec3& point) const {
        return std::max(glm::distance(from, point), glm::distance(to, point)) + radius;
    }
    std::optional<double> support(const glm::dvec3& direction) const {
        return std::max(glm::dot(from, direction), glm::dot(to, direction)) + radius;
    }
    std::optional<double> girth() const { return radius; }
    static constexpr ReadingCost cost{25};
    GlslCall call() const;
};

struct ColliderShape : std::variant<PlaneCollider, SphereCollider, HeightFieldCollider, BoxCollider,
                                    CapsuleCollider, DistanceFieldCollider> {
    using variant::variant;
};

const Description& describe(const SphereCollider*);
const Description& describe(const BoxCollider*);
const Description& describe(const CapsuleCollider*);

}  // namespace shoal
