// A lane a slot in contact: contact/relax.glsl.
#include "contact/touching.glsl"
#include "contact/relax.glsl"

uniform ENTRIES anchors;

layout(std430, binding = 0) writeonly buffer Impulses { vec4 newImpulses[]; };
layout(std430, binding = 1) readonly buffer Pushes { vec4 pushes[]; };
layout(std430, binding = 2) buffer Earlier { vec4 earlierPushes[]; };  // those before them, then the next
layout(std430, binding = 3) buffer Parts { vec2 parts[]; };  // kg m, by entry: x now, y before
layout(std430, binding = 4) writeonly buffer Shifts { vec4 newShifts[]; };
#ifdef WALLS
layout(std430, binding = 7) buffer WallPushes { vec4 wallPushes[]; };
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadOwn(slot);
    int listed = listedOf(slot);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int at = e * listStride + slot;
        vec4 now = pushes[at];
        float part;
        vec3 more;
        vec4 push = relax(slot, entryOf(slot, e), now, momentum == 0.0 ? now.xyz : earlierPushes[at].xyz,
                          entry(anchors, slot, e), momentum == 0.0 ? parts[at].xx : parts[at], part, more);
        parts[at] = vec2(part, parts[at].x);
        shift += more;
        earlierPushes[at] = push;
        impulse += push.xyz;
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS && own.weight > 0.0; ++k) {
        Wall wall = wallOf(slot, k);
        if (!isNear(wall)) break;
        int at = 6 * sphereOf(slot) + 2 * k;
        vec4 now = wallPushes[at];
        vec4 push = relaxWall(wall, now, momentum == 0.0 ? now : wallPushes[at + 1]);
        wallPushes[at + 1] = now;
        wallPushes[at] = push;
        impulse += push.xyz;
        shift += wall.normal * push.w;
    }
#endif
    newShifts[slot] = vec4(shift, 0.0);
    newImpulses[slot] = vec4(impulse - fetch(known, slot).xyz, 0.0);
}
