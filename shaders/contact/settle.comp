// A lane a slot that takes part: contact/settle.glsl, and into the memory of its sphere.
#include "contact/touching.glsl"
#include "contact/settle.glsl"

uniform ENTRIES pushes;
uniform ENTRIES anchors;

layout(std430) buffer Totals { vec4 totals[]; };
// contact/memory.glsl
layout(std430) writeonly buffer Partners { uint partners[]; };
layout(std430) writeonly buffer OldPushes { vec4 oldPushes[]; };
layout(std430) buffer Known { vec4 known[]; };
layout(std430) writeonly buffer OldAnchors { vec4 oldAnchors[]; };
#ifdef WALLS
#include "contact/near_walls.glsl"

layout(std430) buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
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
    bool isHeld = false;
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Entry kept;
        shift += settle(slot, other, Entry(texelFetch(pushes, OWN_ENTRY(e)), texelFetch(anchors, OWN_ENTRY(e))), kept);
        keeps += kept.push.xyz;
        int at = e * listStride + sphere;
        partners[at] = uint(sphereOf(other));
        oldPushes[at] = kept.push;
        oldAnchors[at] = kept.anchor;
    }
#ifdef WALLS
    float now = 0.0;
    for (int k = 0; k < MOST_WALLS; ++k) now += length(wallPushes[2 * (MOST_WALLS * sphere + k)].xyz);
    float part = rememberedOfWalls(known[sphere].w, now);
    for (int k = 0; k < MOST_WALLS; ++k) {
        int at = 2 * (MOST_WALLS * sphere + k);
        wallPushes[at].xyz *= part;
        keeps += wallPushes[at].xyz;
        isHeld = isHeld || wallPushes[at] != vec4(0.0);
        wallPushes[at + 1] = vec4(wallOf(slot, k).normal, 0.0);
    }
#endif
    totals[2 * slot + 1] = vec4(shift, 0.0);
    known[sphere] = vec4(keeps, float(listed) + (isHeld ? 0.5 : 0.0));
}
