// A lane a slot that takes part: contact/relax.glsl. The FIRST iteration also works out the constraints for all.
#include "contact/touching.glsl"
#include "contact/relax.glsl"

// contact/constraint.glsl
#ifdef FIRST
#include "contact/constrain.glsl"

uniform ENTRIES anchors;

layout(std430) writeonly buffer Normals { vec4 normals[]; };
layout(std430) writeonly buffer Amounts { vec4 amounts[]; };

Constraint constraintOf(int slot, int e)
{
    Constraint made = constrain(slot, entryOf(slot, e), texelFetch(anchors, OWN_ENTRY(e)));
    vec4 texels[2] = texelsOf(made);
    normals[OWN_ENTRY(e)] = texels[0];
    amounts[OWN_ENTRY(e)] = texels[1];
    return made;
}
#else
uniform ENTRIES normals;
uniform ENTRIES amounts;

Constraint constraintOf(int slot, int e)
{
    return constraintOf(texelFetch(normals, OWN_ENTRY(e)), texelFetch(amounts, OWN_ENTRY(e)));
}
#endif

uniform FLOATS known;  // contact/memory.glsl: what has acted as a force since the last step

layout(std430) writeonly buffer Totals { vec4 newTotals[]; };
layout(std430) readonly buffer Pushes { vec4 pushes[]; };
layout(std430) buffer EarlierPushes { vec4 earlierPushes[]; };  // read as the ones before, written as the next
#ifndef SPREAD
uniform float nextMomentum;  // of the next iteration

layout(std430) writeonly buffer MotionsNext { vec4 motionsNext[]; };
#endif
#ifdef WALLS
layout(std430) buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadOwn(slot);
    int listed = listedOf(slot);
    vec3 impulse = -fetch(known, sphereOf(slot)).xyz;
    vec3 shift = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int at = OWN_ENTRY(e);
        Constraint asked = constraintOf(slot, e);
        vec4 push = relax(entryOf(slot, e), asked, pushes[at], earlierPushes[at]);
        earlierPushes[at] = push;
        impulse += push.xyz;
        shift += asked.normal * abs(push.w);
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) {
        Wall wall = wallOf(slot, k);
        if (!pressesOn(wall)) break;
        int at = 2 * (MOST_WALLS * sphereOf(slot) + k);
        vec4 now = wallPushes[at];
        vec4 push = relaxWall(wall, now, wallPushes[at + 1]);
        wallPushes[at + 1] = now;
        wallPushes[at] = push;
        impulse += push.xyz;
        shift += wall.normal * push.w;
    }
#endif
    newTotals[2 * slot] = vec4(impulse, 0.0);
    newTotals[2 * slot + 1] = vec4(shift, 0.0);
#ifndef SPREAD
    vec3 further = impulse + (impulse - firstTotal(totals, slot)) * nextMomentum;
    motionsNext[2 * slot] = vec4(own.velocity + further * own.weight, 0.0);
    further = shift + (shift - secondTotal(totals, slot)) * nextMomentum;
    motionsNext[2 * slot + 1] = vec4(further * own.weight, 0.0);
#endif
}
