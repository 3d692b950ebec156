// An impact of the own sphere (contact/response/pair.glsl) with another, for choose.pass.glsl and strike.pass.glsl beside this file, and
// what it leaves.
#include "contact/response/known.glsl"
#include "contact/response/hits.glsl"
#include "contact/response/molecule.glsl"

const uint NOBODY = 0xffffffffu;

// The next impact of a slot.
struct Choice {
    uint other;   // the slot with which it has it, or NOBODY: it has none
    uint entry;   // of its list
    float since;  // s, how long ago
    float speed;  // m/s, along the normal; negative: they approach
};

const Choice noChoice = Choice(NOBODY, 0u, 0.0, 0.0);

uvec4 packedChoice(Choice choice)
{
    return uvec4(choice.other, choice.entry, floatBitsToUint(vec2(choice.since, choice.speed)));
}

Choice choiceFrom(uvec4 word)
{
    return Choice(word.x, word.y, uintBitsToFloat(word.z), uintBitsToFloat(word.w));
}

// Whether the impact that slot a has chosen comes before that of slot b. All that compare two impacts agree.
bool isBefore(int slotOfA, Choice a, int slotOfB, Choice b)
{
    if (a.since != b.since) return a.since > b.since;
    if (a.speed != b.speed) return a.speed < b.speed;
    ivec2 ofA = ivec2(sphereOf(slotOfA), sphereOf(int(a.other)));
    ivec2 ofB = ivec2(sphereOf(slotOfB), sphereOf(int(b.other)));
    ivec2 first = ivec2(min(ofA.x, ofA.y), min(ofB.x, ofB.y));
    ivec2 second = ivec2(max(ofA.x, ofA.y), max(ofB.x, ofB.y));
    return first.x < first.y || (first.x == first.y && second.x < second.y);
}

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

// Returns how an impulse of the own sphere with another changes their relative velocity, m/s.
vec3 gainBetween(Sphere sphere, BodySphere body, vec3 impulse)
{
    vec3 gained = impulse * (own.weight + sphere.weight);
    return BODIES ? gained + (turnedBy(ownBody, impulse) + turnedBy(body, impulse)) : gained;
}

// Returns the impulse on the own sphere, N s: first that along the normal, then what friction takes of the slip that is left. Neither
// adds energy, whatever else the two impulses move.
vec3 impulseOf(PairImpact impact, Sphere sphere, BodySphere body)
{
    vec2 material = materialOf(own, sphere);
    vec3 n = impact.normal;
    vec3 u = own.velocity - sphere.velocity;
    float along = dot(u, n);
    float push = (-material.x * impact.speed - along) / (weightsOf(own, ownBody, n).x + weightsOf(sphere, body, n).x);
    u += gainBetween(sphere, body, n * push);
    vec3 slip = u - n * dot(u, n);
    float speed = sqrt(dot(slip, slip));
    vec3 across = slip / max(speed, 1e-30);
    float stops = dot(across, gainBetween(sphere, body, across));  // 1/kg
    return n * push - across * min(material.y * push, speed / max(stops, 1e-30));
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

// Returns a slot after an impulse on slot a, N s, and the opposite one on slot b, so long ago, s: since then it moves as if it had always had
// the velocity that it has now. `e`: if it is a or b, the other in its list.
Struck struckBy(int slot, int a, int b, vec3 impulse, float since, uint e)
{
    Struck s = struckAs(slot);
    vec3 gained = gainOf(slot, a, impulse) - gainOf(slot, b, impulse);
    bool isHit = slot == a || slot == b;
    if (!isHit && gained == vec3(0.0)) return s;
    s.place.xyz = floatBitsToUint(uintBitsToFloat(s.place.xyz) + gained * since);
    s.motion.xyz = floatBitsToUint(uintBitsToFloat(s.motion.xyz) + gained);
    s.impacts[0].w = floatBitsToUint(since);
    s.impacts[1].w = NOBODY;
    if (!isHit) return s;
    vec3 own = slot == a ? impulse : -impulse;
    s.impacts[0].xyz = floatBitsToUint(uintBitsToFloat(s.impacts[0].xyz) + own);
    s.impacts[1].xyz = floatBitsToUint(uintBitsToFloat(s.impacts[1].xyz) + own * since);
    s.impacts[1].w = uint(slot == a ? b : a);
    s.impacts[2][e >> 5u] |= 1u << (e & 31u);
    return s;
}
