// prepare: a texel a slot, of all entries what contact/prepare.comp sums up.
#include "contact/prepare.glsl"
#ifdef WALLS
uniform sampler2DArray oldWallPushes;  // by slot of the last step
uniform WALL_RECORDS oldWalls;         // by sphere, of the last step
#endif

uniform ENTRIES pushes;
uniform ENTRIES anchors;

layout(location = 0) out vec4 newImpulse;
layout(location = 1) out vec4 newShift;
layout(location = 2) out vec4 newKnown;
#ifdef SPREAD
layout(location = 3) out vec4 newContacts[2];  // contact/effective_sum.glsl
#else
layout(location = 3) out uvec4 newEffectiveCount;
#endif
#if defined(WALLS) && defined(SPREAD)
layout(location = 5) out vec4 newWallPushes[MOST_WALLS];
#elif defined(WALLS)
layout(location = 4) out vec4 newWallPushes[MOST_WALLS];
#endif

void main()
{
    int slot = ownNumber();
    if (slot >= count || fetch(counts, slot).x == 0u) discard;
    loadOld(slot);
    int listed = listedOf(slot);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        Meeting with = meetingAs(slot, entryOf(slot, e), entry(anchors, slot, e));
        if (with.meets) countIn(with.contact.normal);
        vec4 push = entry(pushes, slot, e);
        impulse += push.xyz;
        shift += with.contact.normal * push.w;
    }
    vec4 acted = remembers ? fetch(oldKnown, memory) : vec4(0.0);
    float start = 0.0;  // of all that colliders push
#ifdef WALLS
    OldWall old[MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k)
        old[k] = OldWall(wallTexel(oldWallPushes, memory, k) * vec4(vec3(acted.w), 1.0), wallTexel(oldWalls, sphereOf(slot), 2 * k).xyz);
    vec4 ofWalls[MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k) {
        Wall wall = wallOf(slot, k);
        vec4 push = prepareWall(slot, wall, old);
        ofWalls[k] = push;
        impulse += push.xyz;
        shift += wall.normal * push.w;
        start += length(push.xyz);
    }
    newWallPushes = ofWalls;
#endif
    newImpulse = vec4(impulse - acted.xyz, 0.0);
    newShift = vec4(shift, 0.0);
    newKnown = vec4(acted.xyz, start);
#ifdef SPREAD
    newContacts[0] = vec4(contacts.diagonal, contacts.number);
    newContacts[1] = vec4(contacts.beside, 0.0);
#else
    newEffectiveCount = uvec4(floatBitsToUint(listed > 0 ? effectiveCount(contacts) : 0.0), 0u, 0u, 0u);
#endif
}
