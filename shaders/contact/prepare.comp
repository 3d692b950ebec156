// A lane a slot that takes part: contact/prepare.glsl.
#include "contact/touching.glsl"
#include "contact/prepare.glsl"
#ifdef WALLS
// By sphere, two texels a collider: its push, and that of the iteration before or, between two steps, its normal.
layout(std430) buffer WallPushes { vec4 wallPushes[]; };
#endif

layout(std430) writeonly buffer Totals { vec4 newTotals[]; };
layout(std430) writeonly buffer Pushes { vec4 pushes[]; };
layout(std430) writeonly buffer Anchors { vec4 anchors[]; };
#ifdef SPREAD
layout(std430) writeonly buffer ContactSums { vec4 newContacts[]; };  // two a slot: contact/effective_sum.glsl
#else
layout(std430) writeonly buffer EffectiveCounts { uint newEffectiveCounts[]; };
layout(std430) writeonly buffer MotionsNow { vec4 motionsNow[]; };  // contact/relax.glsl
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadOld(slot);
    int listed = listedOf(slot);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Meeting with;
        Entry known = prepare(slot, other, with);
        if (with.meets) countIn(with.contact.normal);
        impulse += known.push.xyz;
        shift += with.contact.normal * known.push.w;
        pushes[OWN_ENTRY(e)] = known.push;
        anchors[OWN_ENTRY(e)] = known.anchor;
    }
    float start = 0.0;  // of all that colliders push
#ifdef WALLS
    int first = 2 * MOST_WALLS * sphereOf(slot);
    OldWall old[MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k)
        old[k] = OldWall(wallPushes[first + 2 * k], wallPushes[first + 2 * k + 1].xyz);
    for (int k = 0; k < MOST_WALLS; ++k) {
        Wall wall = wallOf(slot, k);
        vec4 push = prepareWall(slot, wall, old);
        wallPushes[first + 2 * k] = push;
        impulse += push.xyz;
        shift += wall.normal * push.w;
        start += length(push.xyz);
    }
#endif
    if (!remembers) known[memory] = vec4(0.0);
    impulse -= known[memory].xyz;
    known[memory].w = start;
    newTotals[2 * slot] = vec4(impulse, 0.0);
    newTotals[2 * slot + 1] = vec4(shift, 0.0);
#ifdef SPREAD
    newContacts[2 * slot] = vec4(contacts.diagonal, contacts.number);
    newContacts[2 * slot + 1] = vec4(contacts.beside, 0.0);
#else
    newEffectiveCounts[slot] = floatBitsToUint(listed > 0 ? effectiveCount(contacts) : 0.0);
    motionsNow[2 * slot] = vec4(own.velocity + impulse * own.weight, 0.0);
    motionsNow[2 * slot + 1] = vec4(shift * own.weight, 0.0);
#endif
}
