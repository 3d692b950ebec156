// A lane a slot in contact: the impulses of all its contacts at once (docs/contact.md). In the order of the stages:
//
//   BEGIN    where spheres rest on one another, the impulse that pushes them apart in this step
//   RELAX    one Jacobi iteration towards each contact's speed after it: -e times that of the impact, or none
//   SETTLE   Coulomb friction, and how far all of it moves the spheres
//
// Only gathers: both spheres of a contact compute its impulse, to the same bit, from the same numbers. `impulses` are
// totals; what a slot without contact has there is undefined and never read.
#include "contact/active.glsl"
#include "contact/records.glsl"
#include "contact/velocity.glsl"
#include "physics/pair.glsl"

uniform usamplerBuffer lists;
uniform usamplerBuffer counts;
uniform usamplerBuffer crowds;     // contacts that a contact of this slot shares its vertices with
uniform samplerBuffer materials;   // x restitution, y friction, by group * groupCount + group
uniform int groupCount;
uniform int listStride;
uniform float stepTime;            // s, of a contact step
uniform float restSpeed;           // m/s
uniform float restPush;            // share of an overlap that a step takes away

layout(std430, binding = 0) writeonly buffer NewImpulses { vec4 newImpulses[]; };
layout(std430, binding = 1) buffer Pushed { float pushed[]; };  // N s, of each entry of the lists
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
    float ownRadius = uintBitsToFloat(texelFetch(cells, sphere).w);
    uint ownCrowd = texelFetch(crowds, slot).x;
    vec3 impulse = vec3(0.0);
    vec3 shift = vec3(0.0);
#ifndef BEGIN
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
        float reach = ownRadius + uintBitsToFloat(texelFetch(cells, otherSphere).w);
        PairContact contact = pairContact(localDifference(ownPlace, uintBitsToFloat(place.xyz), cell),
                                          ownStart - start, reach, stepTime, restSpeed, slot < other ? 1.0 : -1.0);
        float share = 1.0 / float(max(ownCrowd, texelFetch(crowds, other).x));
        bool counts = w > 0.0 && holds(other, slot);
        float push = contact.impact ? 0.0 : share * restPush * contact.depth / max(w, 1e-30);
        vec2 material = texelFetch(materials, int(ownRecord.w >> 26u) * groupCount + int(place.w >> 26u)).xy;
#ifdef BEGIN
        float total = counts ? push / stepTime : 0.0;
        pushed[entry] = total;
        impulse += contact.normal * total;
#else
        vec3 relative = ownVelocity - velocityOf(other, start, weight);
        float speed = dot(relative, contact.normal);
        float before = pushed[entry];
#ifdef RELAX
        float target = contact.impact ? -material.x * contact.speed : max(contact.speed, 0.0);
        float change = counts ? pairImpulse(speed, target, before, w, share) : 0.0;
        pushed[entry] = before + change;
        impulse += contact.normal * change;
#else
        vec3 along = relative - contact.normal * speed;
        float slip = length(along);
        float grip = counts ? min(material.y * before, share * slip / w) : 0.0;
        vec3 rub = along * (-grip / max(slip, 1e-30));
        impulse += rub;
        vec3 bounce = (contact.normal * before + rub) * contact.since;
        shift += counts ? (contact.impact ? bounce : contact.normal * push) : vec3(0.0);
#endif
#endif
    }
    if (taken >= 0) {
        newImpulses[slot] = vec4(impulse, 0.0);
#ifdef SETTLE
        shifts[slot] = vec4(shift, 0.0);
#endif
    }
}
