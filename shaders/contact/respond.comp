// A lane a slot in contact: a stage of contact/respond.glsl.
#include "contact/active.glsl"
#include "contact/respond.glsl"

#ifdef CROWD
#ifdef TRIANGLES
layout(std430, binding = 0) writeonly buffer Normals { vec4 normals[]; };  // two a slot: contact/crowd.comp
#else
layout(std430, binding = 0) writeonly buffer NewCrowds { uint newCrowds[]; };
#endif
#else
layout(std430, binding = 0) writeonly buffer NewImpulses { vec4 newImpulses[]; };
#endif
#ifdef WALLS
uniform samplerBuffer walls;         // by sphere: xyz normal, w distance
uniform samplerBuffer wallFriction;  // x friction, by group

#ifndef CROWD
layout(std430, binding = 4) buffer WallPushed { vec2 wallPushed[]; };
#endif
#endif
#ifdef SETTLE
layout(std430, binding = 2) writeonly buffer Shifts { vec4 shifts[]; };  // kg m
#endif

#ifdef WALLS
// Responds to the collider that the sphere lies on or reaches within a step, as to a contact with a body of
// infinite mass.
void respondToWall(int slot)
{
    vec4 wall = texelFetch(walls, sphereOf(slot));
    if (wall.w < 1e20 && ownWeight > 0.0) {
#ifdef CROWD
        normalSum = withNormal(normalSum, wall.xyz);
#else
        float share = 1.0 / ownCrowd;
#ifdef KEEP
#elif defined(BEGIN)
        wallPushed[slot] = vec2(0.0);
#else
        vec2 pushes = wallPushed[slot];
        float speed = dot(ownVelocity, wall.xyz);
#ifdef RELAX
        float before = pushes.x + (pushes.x - pushes.y) * momentum;
        float change = pairImpulse(speed, -wall.w / stepTime, before, ownWeight, share);
        wallPushed[slot] = vec2(before + change, pushes.x);
        impulse += wall.xyz * change;
#else
        vec3 along = ownVelocity - wall.xyz * speed;
        float slip = length(along);
        float friction = texelFetch(wallFriction, int(ownLabel >> 26u)).x;
        float most = 1.5 / float(numberOf(slot));
        impulse -= along * (min(friction * pushes.x * rubShare, most * slip / ownWeight) / max(slip, 1e-30));
#endif
#endif
#endif
    }
}
#endif

void main()
{
    int taken = activeSlot();
    int slot = max(taken, 0);
    respond(slot, taken < 0 ? 0 : min(int(texelFetch(counts, slot).x), LIST));
#ifdef WALLS
    if (taken >= 0) respondToWall(slot);
#endif
    if (taken >= 0) {
#ifdef CROWD
#ifdef TRIANGLES
        normals[2 * slot] = vec4(normalSum.diagonal, 0.0);
        normals[2 * slot + 1] = vec4(normalSum.beside, 0.0);
#else
        newCrowds[slot] = floatBitsToUint(largestEigenvalue(normalSum));
#endif
#else
        newImpulses[slot] = vec4(impulse, 0.0);
#ifdef SETTLE
        shifts[slot] = shiftOf();
#endif
#endif
    }
}
