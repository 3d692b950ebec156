// A lane a marked slot (contact/rest/marks.glsl) whose molecule rests: what touches it and is awake has worked out their impulse, and
// its memory takes that over. It wakes where its contacts push more than when it came to rest, or much less, or where one has gone
// and the others push otherwise. That they push a little less is no reason: what is awake between two that rest lets go of how these
// squeeze it.
#pragma updates marks warmStart partners keptImpulses keptAnchors restLoads
#include "contact/response/pair.glsl"
#include "contact/rest/mark_groups.glsl"
#include "contact/response/memory.glsl"
#pragma reads markedSlots colliderImpulses

uniform float wakeSpeed;  // m/s

bool isListed(int slot, int other)
{
    bool found = false;
    for (int e = 0; e < listedOf(slot); ++e) found = found || int(listsAt(slot, e)) == other;
    return found;
}

// The contact of two spheres as the memory of the other one has it.
ContactImpulse mirrored(int sphere, int other)
{
    int place = -1;
    for (int e = 0; e < rememberedBy(other); ++e) place = int(partnersAt(other, e)) == sphere ? e : place;
    if (place < 0) return noImpulse(NO_PART);
    ContactImpulse theirs = impulseFrom(keptImpulsesAt(other, place), keptAnchorsAt(other, place));
    theirs.impulse = -theirs.impulse;
    theirs.anchor = -theirs.anchor;
    return theirs;
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
Pushes pushesOn(int sphere)
{
    Pushes all = Pushes(vec3(0.0), 0.0);
    for (int e = 0; e < rememberedBy(sphere); ++e) add(all, keptImpulsesAt(sphere, e).xyz);
    for (int k = 0; k < MOST_COLLIDERS; ++k) add(all, colliderImpulsesAt(sphere, k).xyz);
    return all;
}

// Renews the memory of a sphere, and returns whether it has lost a contact.
bool renew(int slot, int sphere)
{
    bool hasLost = false;
    int kept = 0;
    for (int e = 0; e < rememberedBy(sphere); ++e) {
        int other = partnerSlot(sphere, e);
        bool stays = rests(other);
        hasLost = hasLost || !(stays || isListed(slot, other));
        if (!stays) continue;
        putPartners(sphere, kept, partnersAt(sphere, e));
        putKeptImpulses(sphere, kept, keptImpulsesAt(sphere, e));
        putKeptAnchors(sphere, kept, keptAnchorsAt(sphere, e));
        ++kept;
    }
    for (int e = 0; e < listedOf(slot); ++e) {
        int other = int(listsAt(slot, e));
        if (rests(other) || kept >= LIST) continue;
        ContactImpulse theirs = mirrored(sphere, sphereOf(other));
        putPartners(sphere, kept, uint(sphereOf(other)));
        putKeptImpulses(sphere, kept, firstPart(theirs));
        putKeptAnchors(sphere, kept, theirs.kind == PERSISTENT ? vec4(theirs.anchor, theirs.start) : secondPart(theirs));
        ++kept;
    }
    putWarmStart(sphere, vec4(warmStartAt(sphere).xyz, asMemory(uint(kept) | (memoryCountAt(sphere) & HELD))));
    return hasLost;
}

void main()
{
    if (gl_GlobalInvocationID.x >= marked) return;
    int slot = int(markedSlotsAt(int(gl_GlobalInvocationID.x)));
    if (!rests(slot)) return;
    int sphere = sphereOf(slot);
    float was = restLoadsAt(sphere).w;
    if (was < 0.0) {
        was = pushesOn(sphere).lengths;
        putRestLoads(sphere, vec4(restLoadsAt(sphere).xyz, was));
    }
    bool hasLost = renew(slot, sphere);
    Pushes pushes = pushesOn(sphere);
    float most = wakeSpeed / withoutFlag(motionAt(slot).w);  // infinite where it is held
    bool more = pushes.lengths - was > max(most, 0.25 * was);
    bool less = was - pushes.lengths > max(7.5 * most, 0.4 * was);  // three quarters of its weight
    vec3 before = warmStartAt(sphere).xyz;
    bool differs = length(pushes.sum - before) > max(most, 0.1 * length(before));
    if (more || less || (hasLost && differs)) putMarks(slot, marksAt(slot) | LOAD_CHANGED);
}
