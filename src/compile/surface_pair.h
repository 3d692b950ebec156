// How two surfaces meet: restitution and Coulomb friction, from the rule that names both
// (Scene::surfacePairs), else from the two themselves.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace shoal {

struct SurfacePair {
    double restitution = 0.2;  // in [0, 1]
    double friction = 0.5;     // Coulomb's mu, at least 0
    bool operator==(const SurfacePair&) const = default;
};

// A group against a collider. Without a rule: the collider's own values.
SurfacePair surfacePair(const Scene& scene, const Group& group, const Collider& collider);
// Two groups, by their indices; symmetric. Without a rule: the larger restitution, and the geometric mean of
// the frictions, so that what is smooth stays smooth.
SurfacePair surfacePair(const Scene& scene, size_t groupA, size_t groupB);

// The scene's colliders with the values that they have for this group; none where it does not collide.
std::vector<Collider> collidersOf(const Scene& scene, const Group& group);

}  // namespace shoal
