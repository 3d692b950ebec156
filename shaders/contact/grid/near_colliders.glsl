// Keeps the colliders near a sphere. C++ chooses between two files: nearColliders() of one collider that stands still, or of several.
#define NEAR_SOLIDS
#include "generated/colliders.glsl"
#include "contact/grid/colliders.glsl"
#pragma writes colliders

// Returns the least gap of a collider from sphere k of its molecule, m. The step has answered what colliders do to vertices, but to those of a
// rigid body, and not to triangles.
float leastGap(int k)
{
    return !RIGID && k < VERTICES ? 0.0 : -1e30;
}

NearCollider[MOST_COLLIDERS] noneNear()
{
    NearCollider near[MOST_COLLIDERS];
    for (int w = 0; w < MOST_COLLIDERS; ++w) near[w] = NearCollider(vec3(0.0), 1e30, vec3(0.0), 0.0);
    return near;
}

// Returns how near they have to be that the sphere may press on them within the step, m.
float reachOf(StateSphere own)
{
    return 0.25 * own.radius + length(own.velocity) * contactStep;
}

#include "generated/search_colliders.glsl"

void putNearColliders(int sphere, StateSphere own, int k)
{
    contactRadius = own.radius;
    putAllColliders(sphere, packedColliders(nearColliders(own, k)));
}
