// A lane a marked slot (contact/marks.glsl) whose molecule rests: what touches it and is awake has worked out their impulse, and
// its memory takes that over. It wakes where its contacts push more than when it came to rest, or much less, or where one has gone
// and the others push otherwise. That they push a little less is no reason: what is awake between two that rest lets go of how these
// squeeze it.
#include "contact/respond.glsl"
#include "contact/marked.glsl"

uniform float wakeSpeed;  // m/s

layout(std430) writeonly buffer Totals { vec4 totals[]; };
// contact/memory.glsl
layout(std430) buffer Partners { uint partners[]; };
layout(std430) buffer OldPushes { vec4 oldPushes[]; };
layout(std430) buffer Known { vec4 known[]; };
layout(std430) buffer OldAnchors { vec4 oldAnchors[]; };
layout(std430) buffer Calm { vec4 calm[]; };  // contact/rest.comp
#ifdef WALLS
#include "contact/walls.glsl"

layout(std430) readonly buffer WallPushes { vec4 wallPushes[]; };  // contact/prepare.comp
#endif
uniform usamplerBuffer slots;  // of a sphere
uniform usamplerBuffer markedSlots;

bool isListed(int slot, int other)
{
    bool is = false;
    for (int e = 0; e < listedOf(slot); ++e) is = is || entryOf(slot, e) == other;
    return is;
}

// The contact of two spheres as the memory of the other one has it.
Entry mirrored(int sphere, int other)
{
    int at = -1;
    for (int e = 0; e < int(known[other].w); ++e) at = int(partners[e * listStride + other]) == sphere ? e : at;
    if (at < 0) return Entry(vec4(0.0), vec4(0.0, 0.0, 0.0, -1.0));
    vec4 push = oldPushes[at * listStride + other];
    vec4 anchor = oldAnchors[at * listStride + other];
    return Entry(vec4(-push.xyz, push.w), vec4(-anchor.xyz, anchor.w));
}

// The impulses of the contacts of a sphere, N s.
struct Pushes {
    vec3 sum;
    float lengths;  // the sum of their lengths
};

void add(inout Pushes pushes, vec3 push)
{
    pushes.sum += push;
    pushes.lengths += length(push);
}

// Returns how the memory of a sphere has it.
Pushes rememberedBy(int sphere)
{
    Pushes all = Pushes(vec3(0.0), 0.0);
    for (int e = 0; e < int(known[sphere].w); ++e) add(all, oldPushes[e * listStride + sphere].xyz);
#ifdef WALLS
    for (int k = 0; k < MOST_WALLS; ++k) add(all, wallPushes[2 * (MOST_WALLS * sphere + k)].xyz);
#endif
    return all;
}

void remember(int sphere, int e, uint partner, Entry entry)
{
    int at = e * listStride + sphere;
    partners[at] = partner;
    oldPushes[at] = entry.push;
    oldAnchors[at] = entry.anchor;
}

// Renews the memory of a sphere, and returns whether it has lost a contact.
bool renew(int slot, int sphere)
{
    bool hasLost = false;
    int kept = 0;
    for (int e = 0; e < int(known[sphere].w); ++e) {
        int at = e * listStride + sphere;
        int other = int(texelFetch(slots, int(partners[at])).x);
        bool stays = rests(other);
        hasLost = hasLost || !(stays || isListed(slot, other));
        if (stays) remember(sphere, kept++, partners[at], Entry(oldPushes[at], oldAnchors[at]));
    }
    for (int e = 0; e < listedOf(slot); ++e) {
        int other = entryOf(slot, e);
        if (!rests(other) && kept < LIST)
            remember(sphere, kept++, uint(sphereOf(other)), mirrored(sphere, sphereOf(other)));
    }
    known[sphere].w = float(kept) + fract(known[sphere].w);
    return hasLost;
}

void main()
{
    if (gl_GlobalInvocationID.x >= marked) return;
    int slot = int(texelFetch(markedSlots, int(gl_GlobalInvocationID.x)).x);
    if (!rests(slot)) return;
    loadSphere(slot);
    int sphere = sphereOf(slot);
    if (calm[sphere].w < 0.0) calm[sphere].w = rememberedBy(sphere).lengths;
    bool hasLost = renew(slot, sphere);
    Pushes now = rememberedBy(sphere);
    float most = wakeSpeed / uintBitsToFloat(fetch(motions, sphere).w & ~FRESH);  // infinite where it is held
    float was = calm[sphere].w;
    bool more = now.lengths - was > max(most, 0.25 * was);
    bool less = was - now.lengths > max(7.5 * most, 0.4 * was);  // three quarters of its weight
    vec3 before = known[sphere].xyz;
    bool otherwise = length(now.sum - before) > max(most, 0.1 * length(before));
    totals[2 * slot + 1] = vec4(0.0, 0.0, 0.0, more || less || (hasLost && otherwise) ? 1.0 : 0.0);
}
