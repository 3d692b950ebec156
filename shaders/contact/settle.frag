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
    float part = 1.0;  // of what colliders push
    for (int e = 0; e < listed; ++e) {
        Entry known = Entry(entry(pushes, slot, e), entry(anchors, slot, e));
        Entry kept;
        shift += settle(slot, entryOf(slot, e), known, kept);
        keeps += kept.push.xyz;
    }
#ifdef WALLS
    float now = 0.0;
    for (int k = 0; k < MOST_WALLS; ++k) now += length(wallTexel(wallPushes, slot, k).xyz);
    part = rememberedOfWalls(texelFetch(totals, ivec3(texelOf(slot), 0), 0).w, now);
    for (int k = 0; k < MOST_WALLS; ++k) keeps += wallTexel(wallPushes, slot, k).xyz * part;
#endif
    newImpulse = vec4(firstTotal(totals, slot), 0.0);
    newShift = vec4(shift, 0.0);
    newKnown = vec4(keeps, part);
}
