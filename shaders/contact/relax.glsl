// The stage of contact/respond.glsl that is repeated until contacts have their speeds, or nearly.
#include "contact/respond.glsl"

vec3 impulseAhead(int slot)
{
    vec3 now = impulseOf(slot);
    return now + (now - fetch(earlier, slot).xyz) * momentum;
}

void respond(int slot, int listed)
{
    loadOwn(slot);
    impulse = impulseAhead(slot);
    ownVelocity = velocityOf(slot, own, impulse);
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Meeting with = meetingOf(slot, other);
        PairContact contact = with.contact;
        float speed = dot(ownVelocity - velocityOf(other, with.sphere, impulseAhead(other)), contact.normal);
        vec2 pushes = pushesOf(slot, e);
        float before = max(pushes.x + (pushes.x - pushes.y) * momentum, -1e30);
        float restitution = materialOf(own, with.sphere).x;
        float target = contact.impact ? -restitution * contact.speed : max(contact.speed, 0.0);
        float change = with.meets ? pairImpulse(speed, target, before, with.weight, with.share) : 0.0;
        storePushes(slot, e, vec2(before + change, pushes.x));
        impulse += contact.normal * change;
    }
}

void storeMore(int slot)
{
}

#ifdef WALLS
void respondToWall(int slot, vec4 wall)
{
    vec2 pushes = wallPushesOf(slot);
    float before = pushes.x + (pushes.x - pushes.y) * momentum;
    float change = pairImpulse(dot(ownVelocity, wall.xyz), -wall.w / stepTime, before, own.weight, 1.0 / ownCount);
    storeWallPush(slot, vec2(before + change, pushes.x));
    impulse += wall.xyz * change;
}
#endif
