// The colliders near a slot's sphere. Needs contact/slot_sphere.glsl and `own`.
#include "contact/walls.glsl"

uniform WALL_RECORDS walls;  // by sphere

Wall wallOf(int slot, int k)
{
    int sphere = sphereOf(slot);
    vec4 place = wallTexel(walls, sphere, 2 * k);
    vec4 surface = wallTexel(walls, sphere, 2 * k + 1);
    return Wall(place.xyz, place.w, surface.xyz, surface.w);
}

bool pressesOn(Wall wall)
{
    return wall.gap < 1e20 && own.weight > 0.0;
}
