// relax: a texel a slot, contact/relax.glsl: the colliders, and the totals of all entries.
#include "contact/relax.glsl"

uniform ENTRIES pushes;
uniform ENTRIES normals;  // contact/constraint.glsl
uniform FLOATS known;  // N s, by slot: xyz what has acted as a force since the last step; w what colliders pushed at first
#ifdef WALLS
uniform sampler2DArray wallPushes;  // by slot
uniform sampler2DArray earlierWallPushes;
#endif

layout(location = 0) out vec4 newImpulse;
layout(location = 1) out vec4 newShift;
#ifdef WALLS
layout(location = 2) out vec4 newWallPushes[MOST_WALLS];
#endif

void main()
{
    int slot = ownNumber();
    if (slot >= count || fetch(counts, slot).x == 0u) discard;
    loadOwn(slot);
    int listed = listedOf(slot);
    vec4 acted = fetch(known, slot);
    vec3 impulse = -acted.xyz;
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        vec4 push = entry(pushes, slot, e);
        impulse += push.xyz;
        shift += entry(normals, slot, e).xyz * abs(push.w);
    }
#ifdef WALLS
    vec4 ofWalls[MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k) {
        Wall wall = wallOf(slot, k);
        vec4 push = vec4(0.0);
        if (pressesOn(wall))
            push = relaxWall(wall, wallTexel(wallPushes, slot, k), wallTexel(earlierWallPushes, slot, k));
        ofWalls[k] = push;
        impulse += push.xyz;
        shift += wall.normal * push.w;
    }
    newWallPushes = ofWalls;
#endif
    newImpulse = vec4(impulse, acted.w);
    newShift = vec4(shift, 0.0);
}
