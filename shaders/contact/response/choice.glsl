// The next impact of the own sphere (contact/response/pair.glsl), which choose.pass.glsl chooses and strike.pass.glsl beside this file lets happen.
#include "contact/response/known.glsl"
#include "contact/response/hits.glsl"

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
                      restSpeed);
}

// Whether it is one for the rounds. Where it may be one of many that a molecule has, what would leave too slowly to bounce is left to the
// iterations, which answer all of them at once.
bool isOne(PairImpact impact, Sphere sphere)
{
    return impact.happens && (!SPREADS || -impact.speed * materialOf(own, sphere).x > restSpeed);
}
