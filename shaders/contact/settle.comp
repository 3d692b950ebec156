// A lane a slot that takes part: contact/settle.glsl.
#include "contact/touching.glsl"
#include "contact/settle.glsl"

layout(std430, binding = 0) buffer Totals { vec4 totals[]; };
layout(std430, binding = 1) readonly buffer Pushes { vec4 pushes[]; };
layout(std430, binding = 2) readonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 3) writeonly buffer Known { vec4 newKnown[]; };
#ifdef WALLS
#include "contact/walls.glsl"

layout(std430, binding = 7) readonly buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadSphere(slot);
    int listed = listedOf(slot);
    vec3 shift = totals[2 * slot + 1].xyz;
    vec3 keeps = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int at = e * listStride + slot;
        Entry known = Entry(pushes[at], anchors[at]);
        shift += settle(slot, entryOf(slot, e), known);
        keeps += remembered(known);
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) keeps += wallPushes[2 * (MOST_WALLS * sphereOf(slot) + k)].xyz;
#endif
    totals[2 * slot + 1] = vec4(shift, 0.0);
    newKnown[slot] = vec4(keeps, 0.0);
}
