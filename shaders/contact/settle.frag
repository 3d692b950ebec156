// settle: a texel a slot, contact/settle.glsl.
#include "contact/settle.glsl"
#include "contact/totals.glsl"

uniform ENTRIES pushes;
uniform ENTRIES anchors;
uniform TOTALS totals;
#ifdef WALLS
#include "contact/walls.glsl"

uniform sampler2DArray wallPushes;  // by slot
#endif

layout(location = 0) out vec4 newImpulse;
layout(location = 1) out vec4 newShift;
layout(location = 2) out vec4 newKnown;

void main()
{
    int slot = ownNumber();
    if (slot >= count || fetch(counts, slot).x == 0u) discard;
    loadSphere(slot);
    int listed = listedOf(slot);
    vec3 shift = secondTotal(totals, slot);
    vec3 keeps = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        Entry known = Entry(entry(pushes, slot, e), entry(anchors, slot, e));
        shift += settle(slot, entryOf(slot, e), known);
        keeps += remembered(known);
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) keeps += wallTexel(wallPushes, slot, k).xyz;
#endif
    newImpulse = vec4(firstTotal(totals, slot), 0.0);
    newShift = vec4(shift, 0.0);
    newKnown = vec4(keeps, 0.0);
}
