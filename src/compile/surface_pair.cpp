#include "compile/surface_pair.h"

#include <algorithm>
#include <cmath>

namespace shoal {

static SurfacePair withRule(const Scene& scene, const std::string& a, const std::string& b,
                            SurfacePair fallback) {
    for (const SurfaceRule& rule : scene.surfacePairs) {
        if (!(rule.a == a && rule.b == b) && !(rule.a == b && rule.b == a)) continue;
        return {rule.restitution.value_or(fallback.restitution), rule.friction.value_or(fallback.friction)};
    }
    return fallback;
}

SurfacePair surfacePair(const Scene& scene, const Group& group, const Collider& collider) {
    return withRule(scene, group.surface, collider.surface, {collider.restitution, collider.friction});
}

SurfacePair surfacePair(const Scene& scene, size_t groupA, size_t groupB) {
    const Group &a = scene.groups[groupA], &b = scene.groups[groupB];
    return withRule(scene, a.surface, b.surface,
                    {std::max(a.restitution, b.restitution), std::sqrt(a.friction * b.friction)});
}

std::vector<Collider> collidersOf(const Scene& scene, const Group& group) {
    if (!group.collide) return {};
    std::vector<Collider> out = scene.colliders;
    for (Collider& collider : out) {
        const SurfacePair pair = surfacePair(scene, group, collider);
        collider.restitution = pair.restitution;
        collider.friction = pair.friction;
    }
    return out;
}

}  // namespace shoal
