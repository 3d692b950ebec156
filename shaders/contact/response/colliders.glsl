// The colliders near a slot's sphere.
#include "contact/grid/colliders.glsl"
#include "contact/response/pair.glsl"
#pragma reads colliders

NearCollider colliderOf(int slot, int k)
{
    vec4 place = collidersAt(sphereOf(slot), 2 * k);
    vec4 surface = collidersAt(sphereOf(slot), 2 * k + 1);
    return NearCollider(place.xyz, place.w, surface.xyz, surface.w);
}

bool pressesOn(NearCollider near)
{
    return near.gap < 1e20 && own.weight > 0.0;
}
