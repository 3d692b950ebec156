// A lane a slot in contact: the impulses of all its contacts at once (docs/contact.md). In the order of the stages:
//
//   CROWD    by how much the contacts of a sphere together outdo one alone
//   BEGIN    where spheres rest on one another, a first guess from how far they overlap
//   RELAX    one Jacobi iteration towards each contact's speed after it: -e times that of the impact, or none
//   SETTLE   Coulomb friction, and how far all of it moves the spheres
//   KEEP     spheres that are pushed apart while they sink keep that as velocity, so that a pile does not fall for ever
//
// Only gathers: both spheres of a contact compute its impulse, to the same bit, from the same numbers. `impulses` are
// totals; what a slot without contact has there is undefined and never read.
#include "contact/active.glsl"
#include "contact/records.glsl"
#ifndef CROWD
#include "contact/velocity.glsl"
#endif
#include "physics/pair.glsl"

uniform usamplerBuffer lists;
uniform usamplerBuffer counts;
#ifndef CROWD
uniform usamplerBuffer crowds;     // by slot, as bits: the largest eigenvalue of its contacts' normals, or more
#endif
uniform samplerBuffer materials;   // x restitution, y friction, by group * groupCount + group
uniform int groupCount;
uniform int listStride;
uniform float stepTime;            // s, of a contact step
uniform float restSpeed;           // m/s
uniform float restPush;            // share of an overlap that a step takes away

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
uniform samplerBuffer walls;       // by sphere: xyz normal, w distance
uniform samplerBuffer wallFriction;  // x friction, by group

#ifndef CROWD
layout(std430, binding = 4) buffer WallPushed { vec2 wallPushed[]; };
#endif
#endif
#ifndef CROWD
layout(std430, binding = 1) buffer Pushed { vec2 pushed[]; };  // N s, of each entry of the lists; and the time before
#endif
#ifdef KEEP
uniform samplerBuffer kept;  // w: of shifts
#endif
#ifdef SETTLE
layout(std430, binding = 2) writeonly buffer Shifts { vec4 shifts[]; };  // kg m
#endif

// Whether the list of a slot holds another: one that is full may not, and then neither takes the contact.
bool holds(int slot, int other)
{
    int listed = int(texelFetch(counts, slot).x);
    bool found = listed <= LIST;
    int e = found ? LIST : 0;
    while (e < LIST) {
        found = found || int(texelFetch(lists, e * listStride + slot).x) == other;
        ++e;
    }
    return found;
}

// Contacts that friction shares a sphere with, the wall among them.
int numberOf(int slot)
{
    return int(texelFetch(counts, slot).x) + 1;
}

void main()
{
    int taken = activeSlot();
    int slot = max(taken, 0);
    int listed = taken < 0 ? 0 : min(int(texelFetch(counts, slot).x), LIST);
    int sphere = sphereOf(slot);
    uvec4 ownRecord = texelFetch(places, slot);
    uvec4 ownMotion = texelFetch(motions, sphere);
    vec3 ownPlace = uintBitsToFloat(ownRecord.xyz);
    vec3 ownStart = uintBitsToFloat(ownMotion.xyz);
    float ownWeight = uintBitsToFloat(ownMotion.w);
    float ownRadius = uintBitsToFloat(texelFetch(cells, slot).w);
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
    vec3 rest = vec3(0.0);
#ifdef CROWD
    NormalSum normalSum = NormalSum(vec3(0.0), vec3(0.0));
#else
    float ownCrowd = uintBitsToFloat(texelFetch(crowds, slot).x);
#endif
#ifdef KEEP
    impulse = impulseOf(slot);
    float ownKept = texelFetch(kept, slot).w;
#endif
#if defined(RELAX) || defined(SETTLE)
    vec3 ownVelocity = velocityOf(slot, ownStart, ownWeight);
    impulse = impulseOf(slot);
#endif
    for (int e = 0; e < listed; ++e) {
        int entry = e * listStride + slot;
        int other = int(texelFetch(lists, entry).x);
        uvec4 place = texelFetch(places, other);
        int otherSphere = sphereOf(other);
        uvec4 motion = texelFetch(motions, otherSphere);
        vec3 start = uintBitsToFloat(motion.xyz);
        float weight = uintBitsToFloat(motion.w);
        float w = ownWeight + weight;
        float reach = ownRadius + uintBitsToFloat(texelFetch(cells, other).w);
        PairContact contact = pairContact(localDifference(ownPlace, uintBitsToFloat(place.xyz), cell),
                                          ownStart - start, reach, stepTime, restSpeed, slot < other ? 1.0 : -1.0);
        bool meets = w > 0.0 && holds(other, slot);
#ifdef CROWD
        if (meets) normalSum = withNormal(normalSum, contact.normal);
#else
        float share = 1.0 / max(ownCrowd, uintBitsToFloat(texelFetch(crowds, other).x));
        float push = contact.impact ? 0.0 : share * restPush * contact.depth / max(w, 1e-30);
        vec2 material = texelFetch(materials, int(ownRecord.w >> 26u) * groupCount + int(place.w >> 26u)).xy;
#ifdef BEGIN
        float total = meets ? push / stepTime : 0.0;
        pushed[entry] = vec2(total);
        impulse += contact.normal * total;
#elif defined(KEEP)
        float part = min(ownKept, texelFetch(kept, other).w);
        impulse += meets ? contact.normal * (push / stepTime * part) : vec3(0.0);
#else
        vec3 relative = ownVelocity - velocityOf(other, start, weight);
        float speed = dot(relative, contact.normal);
        vec2 pushes = pushed[entry];
#ifdef RELAX
        float before = max(pushes.x + (pushes.x - pushes.y) * momentum, -1e30);
        float target = contact.impact ? -material.x * contact.speed : max(contact.speed, 0.0);
        float change = meets ? pairImpulse(speed, target, before, w, share) : 0.0;
        pushed[entry] = vec2(before + change, pushes.x);
        impulse += contact.normal * change;
#else
        vec3 along = relative - contact.normal * speed;
        float slip = length(along);
        float before = pushes.x;
        float most = 1.0 / float(max(numberOf(slot), numberOf(other)));
        float grip = meets ? min(material.y * before, most * slip / w) : 0.0;
        vec3 rub = along * (-grip / max(slip, 1e-30));
        impulse += rub;
        vec3 bounce = (contact.normal * before + rub) * contact.since;
        shift += meets && contact.impact ? bounce : vec3(0.0);
        rest += meets ? contact.normal * push : vec3(0.0);
#endif
#endif
#endif
    }
#ifdef WALLS
    // what the sphere lies on, or comes to lie on within a step, holds it like a sphere without end
    vec4 wall = texelFetch(walls, sphere);
    if (taken >= 0 && wall.w < 1e20 && ownWeight > 0.0) {
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
        float friction = texelFetch(wallFriction, int(ownRecord.w >> 26u)).x;
        float most = 1.0 / float(numberOf(slot));
        impulse -= along * (min(friction * pushes.x, most * slip / ownWeight) / max(slip, 1e-30));
#endif
#endif
#endif
    }
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
        vec3 change = rest * (ownWeight / stepTime);
        float kept = clamp(-dot(ownVelocity, change) / max(dot(change, change), 1e-30), 0.0, 1.0);
        shifts[slot] = vec4(shift + rest, kept);
#endif
#endif
    }
}
