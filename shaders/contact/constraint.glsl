// What a contact asks of its impulse, the same in all iterations of a step: worked out once (contact/constrain.glsl), as two 4-vectors
// an entry.
struct Constraint {
    vec3 normal;     // unit, to this slot's sphere
    float target;    // m/s, the relative velocity along it that is wanted
    vec2 weights;    // 1/kg, by what a step of the iteration is divided, along the normal and across it
    float lacks;     // m, by which the spheres are to be moved apart; an impact moves none (-1e30)
    float friction;  // below 0: the contact takes no part
};

vec4[2] texelsOf(Constraint of)
{
    return vec4[2](vec4(of.normal, of.target), vec4(of.weights, of.lacks, of.friction));
}

Constraint constraintOf(vec4 along, vec4 amounts)
{
    return Constraint(along.xyz, along.w, amounts.xy, amounts.z, amounts.w);
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
