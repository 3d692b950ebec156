// A lane a slot in contact: UberFlow's response (section 4.5). Of all that touch only the nearest counts; both are backed up in time
// to their first contact, exchange the impulse there, and move on. The nearest of one need not have it for its nearest:
// where three meet, momentum is lost or gained.
#include "contact/active.glsl"
#include "contact/records.glsl"
#include "physics/pair.glsl"

uniform usamplerBuffer lists;
uniform usamplerBuffer counts;
uniform samplerBuffer materials;
uniform int groupCount;
uniform int listStride;
uniform float stepTime;
uniform float restSpeed;

layout(std430, binding = 0) writeonly buffer NewImpulses { vec4 newImpulses[]; };
layout(std430, binding = 2) writeonly buffer Shifts { vec4 shifts[]; };

void main()
{
    int taken = activeSlot();
    int slot = max(taken, 0);
    int listed = taken < 0 ? 0 : min(int(texelFetch(counts, slot).x), LIST);
    uvec4 own = texelFetch(places, slot);
    int nearest = slot;
    vec3 d = vec3(0.0);
    float least = 1e30;
    for (int e = 0; e < listed; ++e) {
        int other = int(texelFetch(lists, e * listStride + slot).x);
        vec3 apart = localDifference(uintBitsToFloat(own.xyz), uintBitsToFloat(texelFetch(places, other).xyz), cell);
        bool nearer = dot(apart, apart) < least;
        nearest = nearer ? other : nearest;
        d = nearer ? apart : d;
        least = min(least, dot(apart, apart));
    }
    int sphere = sphereOf(slot);
    int otherSphere = sphereOf(nearest);
    uvec4 ownMotion = texelFetch(motions, sphere);
    uvec4 motion = texelFetch(motions, otherSphere);
    vec3 u = uintBitsToFloat(ownMotion.xyz) - uintBitsToFloat(motion.xyz);
    float w = uintBitsToFloat(ownMotion.w) + uintBitsToFloat(motion.w);
    float reach = uintBitsToFloat(texelFetch(cells, slot).w) + uintBitsToFloat(texelFetch(cells, nearest).w);
    PairContact contact = pairContact(d, u, reach, stepTime, restSpeed, slot < nearest ? 1.0 : -1.0);
    vec2 material =
        texelFetch(materials, int(own.w >> 26u) * groupCount + int(texelFetch(places, nearest).w >> 26u)).xy;
    float target = contact.impact ? -material.x * contact.speed : max(contact.speed, 0.0);
    float total = w > 0.0 ? pairImpulse(contact.speed, target, 0.0, w, 1.0) : 0.0;
    vec3 impulse = contact.normal * total;
    vec3 along = u - contact.normal * contact.speed;
    float slip = length(along);
    impulse -= along * (w > 0.0 ? min(material.y * total, slip / w) / max(slip, 1e-30) : 0.0);
    vec3 apart = contact.normal * (w > 0.0 ? contact.depth / w : 0.0);
    if (taken >= 0) {
        newImpulses[slot] = vec4(impulse, 0.0);
        shifts[slot] = vec4(contact.impact ? impulse * contact.since : apart, 0.0);
    }
}
