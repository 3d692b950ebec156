// A lane a marked slot (contact/marks.glsl) whose molecule rests: what touches it and is awake has worked out their impulse, and
// its memory takes that over. It wakes where its contacts now push otherwise than when it came to rest.
#include "contact/respond.glsl"
#include "contact/marked.glsl"

uniform ENTRIES pushes;
uniform ENTRIES anchors;
uniform float wakeSpeed;  // m/s

layout(std430, binding = 0) writeonly buffer Totals { vec4 totals[]; };
// contact/memory.glsl
layout(std430, binding = 1) buffer Partners { uint partners[]; };
layout(std430, binding = 2) buffer OldPushes { vec4 oldPushes[]; };
layout(std430, binding = 3) buffer Known { vec4 known[]; };
layout(std430, binding = 4) buffer OldAnchors { vec4 oldAnchors[]; };
layout(std430, binding = 5) readonly buffer MarkedSlots { uint markedSlots[]; };
#ifdef WALLS
#include "contact/walls.glsl"

layout(std430, binding = 6) readonly buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
#endif
uniform usamplerBuffer slots;  // of a sphere

bool restsAt(int slot)
{
    return isResting(fetch(cells, slot).w, fetch(marks, slot).x);
}

// The contact of a slot as the list of the other one has it.
Entry mirrored(int slot, int other)
{
    int at = -1;
    for (int e = 0; e < listedOf(other); ++e) at = entryOf(other, e) == slot ? e : at;
    if (at < 0) return Entry(vec4(0.0), vec4(0.0, 0.0, 0.0, -1.0));
    vec4 push = entry(pushes, other, at);
    vec4 anchor = entry(anchors, other, at);
    return Entry(vec4(-push.xyz, push.w), vec4(-anchor.xyz, anchor.w));
}

void main()
{
    if (gl_GlobalInvocationID.x >= marked) return;
    int slot = int(markedSlots[gl_GlobalInvocationID.x]);
    if (!restsAt(slot)) return;
    loadSphere(slot);
    int sphere = sphereOf(slot);
    vec3 keeps = vec3(0.0);
    int kept = 0;
    for (int e = 0; e < int(known[sphere].w); ++e) {
        int at = e * listStride + sphere;
        if (restsAt(int(texelFetch(slots, int(partners[at])).x))) {
            int to = kept * listStride + sphere;
            Entry old = Entry(oldPushes[at], oldAnchors[at]);
            partners[to] = partners[at];
            oldPushes[to] = old.push;
            oldAnchors[to] = old.anchor;
            keeps += old.push.xyz;
            ++kept;
        }
    }
    for (int e = 0; e < listedOf(slot); ++e) {
        int other = entryOf(slot, e);
        if (!restsAt(other) && kept < LIST) {
            int to = kept * listStride + sphere;
            Entry now = remembered(mirrored(slot, other), sphereAt(other));
            partners[to] = uint(sphereOf(other));
            oldPushes[to] = now.push;
            oldAnchors[to] = now.anchor;
            keeps += now.push.xyz;
            ++kept;
        }
    }
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) keeps += wallPushes[2 * (MOST_WALLS * sphere + k)].xyz;
#endif
    vec3 before = known[sphere].xyz;
    float weight = uintBitsToFloat(fetch(motions, sphere).w & ~FRESH);
    float otherwise = length(keeps - before) * weight;
    totals[2 * slot + 1] = vec4(0.0, 0.0, 0.0, otherwise > max(wakeSpeed, 0.25 * length(before) * weight) ? 1.0 : 0.0);
    known[sphere].w = float(kept) + fract(known[sphere].w);
}
