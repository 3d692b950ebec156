// A lane a slot that takes part: contact/constrain.glsl.
#include "contact/touching.glsl"
#include "contact/constrain.glsl"
#include "contact/totals.glsl"

uniform ENTRIES anchors;

layout(std430, binding = 0) writeonly buffer Normals { vec4 normals[]; };
layout(std430, binding = 1) writeonly buffer Amounts { vec4 amounts[]; };
#ifndef SPREAD
uniform TOTALS totals;

layout(std430, binding = 2) writeonly buffer MotionsNow { vec4 motionsNow[]; };  // contact/relax.glsl
#endif

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadSphere(slot);
    int listed = listedOf(slot);
    for (int e = 0; e < listed; ++e) {
        vec4 one[2] = texelsOf(constrain(slot, entryOf(slot, e), texelFetch(anchors, OWN_ENTRY(e))));
        normals[OWN_ENTRY(e)] = one[0];
        amounts[OWN_ENTRY(e)] = one[1];
    }
#ifndef SPREAD
    motionsNow[2 * slot] = vec4(own.velocity + firstTotal(totals, slot) * own.weight, 0.0);
    motionsNow[2 * slot + 1] = vec4(secondTotal(totals, slot) * own.weight, 0.0);
#endif
}
