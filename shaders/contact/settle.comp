// A lane a slot in contact: contact/settle.glsl.
#include "contact/touching.glsl"
#include "contact/settle.glsl"
layout(std430, binding = 1) readonly buffer Pushes { vec4 pushes[]; };
layout(std430, binding = 2) readonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 3) writeonly buffer Shifts { vec4 newShifts[]; };
layout(std430, binding = 4) writeonly buffer Known { vec4 newKnown[]; };
#ifdef WALLS
layout(std430, binding = 7) readonly buffer WallPushes { vec4 wallPushes[]; };
#endif

uniform FLOATS parted;  // kg m: what pushes apart what overlaps

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadOwn(slot);
    int listed = listedOf(slot);
    vec3 shift = fetch(parted, slot).xyz;
    vec3 load = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int at = e * listStride + slot;
        Entry known = Entry(pushes[at], anchors[at]);
        shift += settle(slot, entryOf(slot, e), known);
        load += remembered(known);
    }
#ifdef WALLS
    for (int k = 0; k < 3; ++k) load += wallPushes[6 * sphereOf(slot) + 2 * k].xyz;
#endif
    newShifts[slot] = vec4(shift, 0.0);
    newKnown[slot] = vec4(load, 0.0);
}
