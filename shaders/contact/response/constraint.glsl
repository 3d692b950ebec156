// The constraint of a contact's impulse, the same in all iterations of a step: worked out once, with buffers in the first iteration and in
// fragments in a pass before it, and kept in two parts.
#include "contact/response/pair.glsl"

struct Constraint {
    vec3 normal;     // unit, to this slot's sphere
    float target;    // m/s, the relative velocity along it that is wanted
    vec2 weights;    // 1/kg, by what a step of the iteration is divided, along the normal and across it
    float lacks;     // m, by which the spheres are to be moved apart; an impact moves none (-1e30)
    float friction;  // below 0: the contact takes no part
};

Constraint constraintFrom(vec4 normal, vec4 weights)
{
    return Constraint(normal.xyz, normal.w, weights.xy, weights.z, weights.w);
}

// An iteration takes a larger step towards several contacts at once than one that is certainly stable without momentum; a contact
// alone has its impulse at once.
const float overRelaxed = 1.3;
const float pushSpeed = 1.0;  // m/s: what overlaps is pushed apart no faster

// m/s, at which a contact that rests is to part: what it may still close, or a little of what overlaps too much.
float partingSpeed(float depth, float reach)
{
    return (min(depth, 0.0) + clamp(0.1 * (depth - restingOverlap * reach), 0.0, 0.1 * stepTime)) / stepTime;
}

// m, by which it is to be moved apart.
float lacking(float depth, float reach)
{
    return min(depth - restingOverlap * reach, pushSpeed * stepTime);
}

// 1/kg, by what the step is divided, along the normal and across it. `count`: of the contacts that are answered at once.
vec2 stepWeights(vec2 weights, float count)
{
    return isAlone(count) ? weights : weights / vec2(overRelaxed, overRelaxed * frictionStep);
}

// `begun`: the contact's impulse from prepare().
Constraint constrain(int slot, int other, ContactImpulse begun)
{
    Pair pair = pairAs(slot, other, begun);
    PairContact contact = pair.contact;
    vec2 effective = vec2(effectiveCountOf(slot, own), effectiveCountOf(other, pair.sphere));
    vec2 weights = stepWeights(weightsBetween(pair, contact.normal, effective), max(effective.x, effective.y));
    float reach = own.radius + pair.sphere.radius;
    float target = contact.impact ? -pair.material.x * contact.speed : partingSpeed(contact.depth, reach);
    float lacks = contact.impact ? -1e30 : lacking(contact.depth, reach);
    return Constraint(contact.normal, target, weights, lacks, pair.meets ? pair.material.y : -1.0);
}
