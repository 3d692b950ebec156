// A lane a slot that takes part: contact/settle.glsl, and into the memory of its sphere.
#include "contact/touching.glsl"
#include "contact/settle.glsl"

uniform ENTRIES pushes;
uniform ENTRIES anchors;

layout(std430, binding = 0) buffer Totals { vec4 totals[]; };
// contact/memory.glsl
layout(std430, binding = 1) writeonly buffer Partners { uint partners[]; };
layout(std430, binding = 2) writeonly buffer OldPushes { vec4 oldPushes[]; };
layout(std430, binding = 3) writeonly buffer Known { vec4 known[]; };
layout(std430, binding = 4) writeonly buffer OldAnchors { vec4 oldAnchors[]; };
#ifdef WALLS
#include "contact/near_walls.glsl"

layout(std430, binding = 7) buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadSphere(slot);
    int sphere = sphereOf(slot);
    int listed = listedOf(slot);
    vec3 shift = totals[2 * slot + 1].xyz;
    vec3 keeps = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Entry kept = Entry(entry(pushes, slot, e), entry(anchors, slot, e));
        shift += settle(slot, other, kept);
        keeps += remembered(kept);
        int at = e * listStride + sphere;
        partners[at] = uint(sphereOf(other));
        oldPushes[at] = kept.push;
        oldAnchors[at] = kept.anchor;
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) {
        int at = 2 * (MOST_WALLS * sphere + k);
        keeps += wallPushes[at].xyz;
        wallPushes[at + 1] = vec4(wallOf(slot, k).normal, 0.0);
    }
#endif
    totals[2 * slot + 1] = vec4(shift, 0.0);
    known[sphere] = vec4(keeps, float(listed));
}
