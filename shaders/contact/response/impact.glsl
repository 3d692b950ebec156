// An impact of the own sphere (contact/response/pair.glsl) with another, for choose.pass.glsl and strike.pass.glsl beside this file, and
// what it leaves.
#include "contact/response/known.glsl"
#include "contact/response/hits.glsl"

const uint NOBODY = 0xffffffffu;

// For how long both spheres have moved straight, s.
float straightTime(int slot, int other, Sphere sphere)
{
    if (isFirst) return stepTime;
    float time = straightTimeOf(slot);
    return sphere.weight > 0.0 ? min(time, straightTimeOf(other)) : time;
}

bool areStruck(int slot, int other, Sphere sphere)
{
    return !isFirst && (isStruck(slot) || (sphere.weight > 0.0 && isStruck(other)));
}

// Whether the two have had their impact, and nothing has moved them since.
bool haveMet(int slot, int other, Sphere sphere)
{
    if (isFirst || !isStruck(slot) || lastHitOf(slot) != other) return false;
    return sphere.weight == 0.0 || lastHitOf(other) == slot;
}

PairImpact impactOf(int slot, int other, Sphere sphere)
{
    vec3 apart = localDifference(own.place, sphere.place, cell);
    return nextImpact(apart, own.velocity - sphere.velocity, own.radius + sphere.radius, straightTime(slot, other, sphere),
                      restSpeed, slot < other ? 1.0 : -1.0);
}

// Returns the impulse on the own sphere, N s.
vec3 impulseOf(PairImpact impact, Sphere sphere)
{
    vec2 material = materialOf(own, sphere);
    vec3 impulse = pairImpulse(own.velocity - sphere.velocity, impact.normal, -material.x * impact.speed, vec3(0.0),
                               vec2(own.weight + sphere.weight));
    return withinFriction(impulse, impact.normal, material.y);
}

// All of a slot that an impact changes.
struct Struck {
    uvec4 place;
    uvec4 motion;
    uvec4[3] impacts;
};

Struck struckAs(int slot)
{
    Struck s = Struck(placesAt(slot), motionAt(slot), uvec4[3](NO_IMPACT, uvec4(0u), uvec4(0u)));
    if (!isFirst && isStruck(slot)) s.impacts = uvec4[3](impactsAt(slot, 0), impactsAt(slot, 1), impactsAt(slot, 2));
    return s;
}

// Returns the slot after an impulse, N s, so long ago, s, by entry e of its list: since then it moves as if it had always had the
// velocity that it has now.
Struck struckBy(int slot, int other, vec3 impulse, float since, uint e)
{
    Struck s = struckAs(slot);
    vec3 gained = impulse * withoutFlag(s.motion.w);
    s.place.xyz = floatBitsToUint(uintBitsToFloat(s.place.xyz) + gained * since);
    s.motion.xyz = floatBitsToUint(uintBitsToFloat(s.motion.xyz) + gained);
    s.impacts[0] = floatBitsToUint(vec4(uintBitsToFloat(s.impacts[0].xyz) + impulse, since));
    s.impacts[1].xyz = floatBitsToUint(uintBitsToFloat(s.impacts[1].xyz) + impulse * since);
    s.impacts[1].w = uint(other);
    s.impacts[2][e >> 5u] |= 1u << (e & 31u);
    return s;
}
