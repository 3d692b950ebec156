// Keeps the colliders near a sphere, if its group meets any (COLLIDES).
#include "contact/grid/sphere.glsl"
#ifdef COLLIDES
#define NEAR_SOLIDS
#include "generated/colliders.glsl"
#include "contact/grid/colliders.glsl"
#pragma writes colliders

// Those that sphere k of its molecule may press on within the step, the nearest first. The step has answered what colliders do to
// vertices, but to those of a rigid body, and not to triangles.
void putNearColliders(int sphere, StateSphere own, int k)
{
    contactRadius = own.radius;
    float reach = 0.25 * own.radius + length(own.velocity) * contactStep;  // m
    float least = !RIGID && k < VERTICES ? 0.0 : -1e30;                    // m, of a gap
    NearCollider near[MOST_COLLIDERS];
    for (int w = 0; w < MOST_COLLIDERS; ++w) near[w] = NearCollider(vec3(0.0), 1e30, vec3(0.0), 0.0, false);
#ifdef SEVERAL_COLLIDERS
    ivec3 skip = ivec3(-1);
    waySquared = 0.0;  // distances as they are
    for (int w = 0; w < MOST_COLLIDERS; ++w) {
        Touch t = survey(own.anchor, own.position, own.velocity, contactStep, skip).swept;
        if (t.which < 0 || t.distance >= reach) break;
        near[w] = NearCollider(t.normal, max(t.distance, least), t.velocity, materialOf(t).y, materialOf(t).x > 0.0);
        skip = ivec3(skip.y, t.which, -1);
    }
#else
    vec4 surface = surfaceAt(own.anchor, own.position);  // of the scene's only collider, which stands still
    vec2 material = colliderParameters[0].xy;
    if (surface.w < reach)
        near[0] = NearCollider(surface.xyz, max(surface.w, least), vec3(0.0), material.y, material.x > 0.0);
#endif
    putAllColliders(sphere, packedColliders(near));
}
#else
void putNearColliders(int sphere, StateSphere own, int k)
{
}
#endif
