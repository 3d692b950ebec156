// The stage of contact/respond.glsl that is repeated in each round of friction.
#include "contact/respond.glsl"

#ifndef TEXTURES
layout(std430, binding = 2) writeonly buffer Shifts { vec4 shifts[]; };
#endif

// Contacts that friction shares a sphere with, the wall among them.
int numberOf(int slot)
{
    return int(fetch(counts, slot).x) + 1;
}

vec4 shift;  // xyz kg m, how far it moves; w how much of the correction it keeps as velocity

void respond(int slot, int listed)
{
    loadOwn(slot);
    impulse = impulseOf(slot);
    ownVelocity = velocityOf(slot, own, impulse);
    vec3 bounced = vec3(0.0);
    vec3 corrected = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Meeting with = meetingOf(slot, other);
        vec3 n = with.contact.normal;
        vec3 relative = ownVelocity - velocityOf(other, with.sphere, impulseOf(other));
        vec3 along = relative - n * dot(relative, n);
        float slip = length(along);
        float pushes = pushesOf(slot, e).x;
        float friction = materialOf(own, with.sphere).y;
        float most = 1.5 / float(max(numberOf(slot), numberOf(other)));
        float grip = min(friction * pushes * frictionShare, most * slip / with.weight);
        // A pair alone needs no rounds: all that its spheres have exchanged besides the push is friction.
        bool alone = isAlone(with.share);
        float spent = length(impulse - n * pushes);
        grip = alone ? min(max(friction * pushes - spent, 0.0), slip / with.weight) : grip;
        vec3 change = along * (with.meets ? -grip / max(slip, 1e-30) : 0.0);
        impulse += change;
        vec3 bounce = (alone ? impulse : n * pushes + change) * with.contact.since;
        bounced += with.meets && with.contact.impact ? bounce : vec3(0.0);
        corrected += with.meets ? n * with.correction : vec3(0.0);
    }
    vec3 gained = corrected * (own.weight / stepTime);
    shift = vec4(bounced + corrected, clamp(-dot(ownVelocity, gained) / max(dot(gained, gained), 1e-30), 0.0, 1.0));
}

void storeMore(int slot)
{
#ifdef TEXTURES
    stored[0] = shift;
#else
    shifts[slot] = shift;
#endif
}

#ifdef WALLS
void respondToWall(int slot, vec4 wall)
{
    float push = wallPushesOf(slot).x;
#ifdef TEXTURES
    wallPush = push;  // for the next round
#endif
    vec3 along = ownVelocity - wall.xyz * dot(ownVelocity, wall.xyz);
    float slip = length(along);
    float friction = fetch(wallFriction, int(own.label >> 26u)).x;
    float most = 1.5 / float(numberOf(slot));
    impulse -= along * (min(friction * push * frictionShare, most * slip / own.weight) / max(slip, 1e-30));
}
#endif
