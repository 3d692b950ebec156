// The last stage of contact/respond.glsl: velocity from the correction of penetration.
#include "contact/respond.glsl"

uniform FLOATS kept;  // w: the share of its correction that a sphere keeps as velocity (contact/friction.glsl)

void respond(int slot, int listed)
{
    loadOwn(slot);
    impulse = impulseOf(slot);
    float ownKept = fetch(kept, slot).w;
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Meeting with = meetingOf(slot, other);
        float part = min(ownKept, fetch(kept, other).w);
        impulse += with.meets ? with.contact.normal * (with.correction / stepTime * part) : vec3(0.0);
    }
}

void storeMore(int slot)
{
}

#ifdef WALLS
void respondToWall(int slot, vec4 wall)
{
}
#endif
