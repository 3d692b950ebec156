// The first stage of contact/respond.glsl.
#include "contact/respond.glsl"

void respond(int slot, int listed)
{
    loadOwn(slot);
    for (int e = 0; e < listed; ++e) {
        Meeting with = meetingOf(slot, entryOf(slot, e));
        float total = with.meets ? with.correction / stepTime : 0.0;
        storePushes(slot, e, vec2(total));
        impulse += with.contact.normal * total;
    }
}

void storeMore(int slot)
{
}

#ifdef WALLS
void respondToWall(int slot, vec4 wall)
{
    storeWallPush(slot, vec2(0.0));
}
#endif
