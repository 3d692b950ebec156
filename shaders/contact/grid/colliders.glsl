// A collider near a sphere, in two texels of `colliders`.
#include "contact/flags.glsl"
#pragma reads colliders

struct NearCollider {
    vec3 normal;    // unit
    float gap;      // m, from the sphere's centre to where it would rest; 1e30: none is near
    vec3 velocity;  // m/s, of the surface
    float friction;
    bool bounces;   // it has restitution
};

bool isNear(NearCollider collider)
{
    return collider.gap < 1e20;
}

vec4[2 * MOST_COLLIDERS] packedColliders(NearCollider near[MOST_COLLIDERS])
{
    vec4 texels[2 * MOST_COLLIDERS];
    for (int k = 0; k < MOST_COLLIDERS; ++k) {
        texels[2 * k] = vec4(near[k].normal, near[k].gap);
        texels[2 * k + 1] = vec4(near[k].velocity, uintBitsToFloat(withFlag(near[k].friction, near[k].bounces)));
    }
    return texels;
}

NearCollider colliderNear(int sphere, int k)
{
    vec4 place = collidersAt(sphere, 2 * k);
    vec4 surface = collidersAt(sphere, 2 * k + 1);
    uint friction = floatBitsToUint(surface.w);
    return NearCollider(place.xyz, place.w, surface.xyz, withoutFlag(friction), hasFlag(friction));
}
