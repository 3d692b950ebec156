// A lane a marked slot (contact/rest/marks.glsl) whose molecule rests: what touches it and is awake has worked out their impulse, and
// its memory takes that over where it is the longer one. It wakes where its contacts push more than when it came to rest, or much less,
// or where one has gone and the others push otherwise. That they push a little less is no reason, and the memory keeps what they pushed:
// what is awake between two that rest lets go of how these squeeze it, and when they wake, their springs still push as they did.
#pragma updates marks warmStart partners keptImpulses keptAnchors restLoads
#include "contact/response/known.glsl"
#include "contact/rest/mark_groups.glsl"
#pragma reads markedSlots colliderImpulses

uniform float wakeSpeed;  // m/s

bool isListed(int slot, int other)
{
    bool found = false;
    for (int e = 0; e < listedOf(slot); ++e) found = found || int(listsAt(slot, e)) == other;
    return found;
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

Pushes pushesOfColliders(int sphere)
{
    Pushes all = Pushes(vec3(0.0), 0.0);
    for (int k = 0; k < MOST_COLLIDERS; ++k) add(all, colliderImpulsesAt(sphere, k).xyz);
    return all;
}

// Returns how the memory of a sphere has it.
Pushes pushesOn(int sphere)
{
    Pushes all = pushesOfColliders(sphere);
    for (int e = 0; e < rememberedBy(sphere); ++e) add(all, keptImpulsesAt(sphere, e).xyz);
    return all;
}

// Returns which of the first `kept` entries is the contact with another sphere, or -1.
int placeIn(int sphere, int kept, int other)
{
    int place = -1;
    for (int e = 0; e < kept; ++e) place = int(partnersAt(sphere, e)) == other ? e : place;
    return place;
}

// What has become of the contacts of a sphere.
struct Renewed {
    Pushes pushes;  // now
    bool hasLost;   // one of them
};

void keep(int sphere, int place, int other, ContactImpulse contact)
{
    putPartners(sphere, place, uint(other));
    putKeptImpulses(sphere, place, firstPart(contact));
    putKeptAnchors(sphere, place, contact.kind == PERSISTENT ? vec4(contact.anchor, contact.start) : secondPart(contact));
}

Renewed renew(int slot, int sphere)
{
    Renewed all = Renewed(pushesOfColliders(sphere), false);
    int kept = 0;
    for (int e = 0; e < rememberedBy(sphere); ++e) {
        int other = int(partnersAt(sphere, e));
        int otherSlot = partnerSlot(sphere, e);
        bool stays = rests(otherSlot) || isListed(slot, otherSlot);
        all.hasLost = all.hasLost || !stays;
        if (!stays) continue;
        ContactImpulse known = impulseFrom(keptImpulsesAt(sphere, e), keptAnchorsAt(sphere, e));
        ContactImpulse theirs = rests(otherSlot) ? known : mirrored(contactIn(other, sphere));
        add(all.pushes, theirs.impulse);
        keep(sphere, kept, other, length(theirs.impulse) > length(known.impulse) ? theirs : known);
        ++kept;
    }
    int listed = listedOf(slot);
    for (int e = 0; e < listed; ++e) {
        int otherSlot = int(listsAt(slot, e));
        int other = sphereOf(otherSlot);
        if (rests(otherSlot) || placeIn(sphere, kept, other) >= 0) continue;
        ContactImpulse theirs = mirrored(contactIn(other, sphere));
        add(all.pushes, theirs.impulse);
        if (kept < LIST) keep(sphere, kept++, other, theirs);
    }
    putWarmStart(sphere, vec4(warmStartAt(sphere).xyz, asMemory(uint(kept) | (memoryCountAt(sphere) & HELD))));
    return all;
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
    Renewed renewed = renew(slot, sphere);
    float most = wakeSpeed / withoutFlag(motionAt(slot).w);  // infinite where it is held
    bool more = renewed.pushes.lengths - was > max(most, 0.25 * was);
    bool less = was - renewed.pushes.lengths > max(7.5 * most, 0.4 * was);  // three quarters of its weight
    vec3 before = warmStartAt(sphere).xyz;
    bool differs = length(renewed.pushes.sum - before) > max(most, 0.1 * length(before));
    if (more || less || (renewed.hasLost && differs)) putMarks(slot, marksAt(slot) | LOAD_CHANGED);
}
