// Keeps the colliders near a sphere, if its group meets any (COLLIDES).
#ifdef COLLIDES
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

#ifdef SEVERAL_COLLIDERS
// Those of the scene's colliders that sphere k of its molecule may press on, the nearest first.
NearCollider[MOST_COLLIDERS] nearColliders(StateSphere own, int k)
{
    NearCollider near[MOST_COLLIDERS] = noneNear();
    float reach = reachOf(own);
    ivec3 skip = ivec3(-1);
    waySquared = 0.0;  // distances as they are
    for (int w = 0; w < MOST_COLLIDERS; ++w) {
        Touch t = survey(own.anchor, own.position, own.velocity, contactStep, skip).swept;
        if (t.which < 0 || t.distance >= reach) break;
        near[w] = NearCollider(t.normal, max(t.distance, leastGap(k)), t.velocity, materialOf(t).y);
        skip = ivec3(skip.y, t.which, -1);
    }
    return near;
}
#else
// The nearest place of the scene's only collider, which stands still.
NearCollider[MOST_COLLIDERS] nearColliders(StateSphere own, int k)
{
    NearCollider near[MOST_COLLIDERS] = noneNear();
    vec4 surface = surfaceAt(own.anchor, own.position);
    if (surface.w < reachOf(own))
        near[0] = NearCollider(surface.xyz, max(surface.w, leastGap(k)), vec3(0.0), colliderParameters[0].y);
    return near;
}
#endif

void putNearColliders(int sphere, StateSphere own, int k)
{
    contactRadius = own.radius;
    putAllColliders(sphere, packedColliders(nearColliders(own, k)));
}
#else
void putNearColliders(int sphere, StateSphere own, int k)
{
}
#endif
