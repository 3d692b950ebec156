// The first stage of contact/respond.glsl: what contacts remember of the last step.
#include "contact/respond.glsl"

uniform UINTS oldSlots;      // of a sphere, in the last step
uniform UINTS oldCounts;     // by slot of the last step
uniform ENTRIES oldPushes;   // the same
uniform ENTRIES oldAnchors;
uniform FLOATS oldKnown;     // N s, by slot: what has acted as a force since

int oldSlot;
int oldListed;

// Where the last step left what it knew of the sphere.
void loadOld(int slot)
{
    oldSlot = int(fetch(oldSlots, sphereOf(slot)).x);
    oldListed = min(int(fetch(oldCounts, oldSlot).x & CONTACTS), LIST);
}

Entry prepare(int slot, int other, out Meeting with)
{
    uint sphere = uint(sphereOf(other));
    Entry old;
    bool isOld = false;
    for (int e = 0; e < oldListed; ++e) {
        vec4 push = entry(oldPushes, oldSlot, e);
        if ((floatBitsToUint(push.w) & SPHERE) == sphere) {
            old = Entry(push, entry(oldAnchors, oldSlot, e));
            isOld = old.anchor.w >= 0.0;
        }
    }
    with = meetingOf(slot, other, isOld ? 1e30 : restSpeed);
    float reach = own.radius + with.sphere.radius;
    vec3 place = with.contact.impact ? with.contact.normal * reach : with.apart;
    Entry known = Entry(vec4(vec3(0.0), uintBitsToFloat(sphere)), vec4(place, 0.0));
    if (with.contact.impact) return known;
    if (!isOld && with.contact.depth <= 0.0 && with.contact.speed < -restSpeed) with.meets = false;
    if (!with.meets) {
        known.anchor.w = -1.0;
        return known;
    }
    if (isOld) {
        known.push.xyz = remembered(old);
        bool sticks = (floatBitsToUint(old.push.w) & (SLIDES | IMPACT)) == 0u;
        if (sticks || isDeep(with.contact, reach)) known.anchor.xyz = old.anchor.xyz;
    }
    leaveAsCome(with, known.anchor.xyz);
    vec3 n = with.contact.normal;
    known.push.xyz = withinFriction(known.push.xyz, n, with.material.y);
    known.anchor.w = length(known.push.xyz) + 1e-20;
    return known;
}
