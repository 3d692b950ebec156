// One Jacobi iteration of the impulse of a contact, from the last two. Needs `momentum`, Nesterov's: by how much of its last change an
// iteration goes on first.
#include "contact/response/pair.glsl"
#pragma reads impulses earlierImpulses totals earlierTotals velocities

// The constraint of a contact's impulse, the same in all iterations of a step: worked out once, with buffers in the first iteration and in
// fragments in a pass before it.
struct Constraint {
    vec3 normal;     // unit, to this slot's sphere
    float target;    // m/s, the relative velocity along it that is wanted
    vec2 weights;    // 1/kg, by what a step of the iteration is divided, along the normal and across it
    float lacks;     // m, by which the spheres are to be moved apart
    float friction;  // below 0: the contact takes no part
};

// An iteration takes a larger step towards several contacts at once than one that is certainly stable without momentum; a contact
// alone has its impulse at once.
const float overRelaxed = 1.3;

// m/s, at which the spheres of a contact are to part: they may still close what is open. A little of what overlaps too much parts what
// carries something; elsewhere it would be energy from nowhere.
float partingSpeed(float depth, float reach, bool loaded)
{
    float much = loaded ? clamp(0.1 * (depth - restingOverlap * reach), 0.0, 0.1 * stepTime) : 0.0;
    return (min(depth, 0.0) + much) / stepTime;
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
    return Constraint(contact.normal, partingSpeed(contact.depth, reach, isLoaded(begun)), weights, lacking(contact.depth, reach),
                      pair.meets ? pair.material.y : -1.0);
}

#ifndef FIRST
#pragma reads normals weights partnerRows rowSpheres

// Returns what was worked out.
Constraint constraintOf(int slot, int e)
{
    vec4 normal = normalsAt(ownRow(slot), e);
    vec4 weights = weightsAt(ownRow(slot), e);
    return Constraint(normal.xyz, normal.w, weights.xy, weights.z, weights.w);
}
#endif

// How impulses and shifts so far, and the iteration's momentum, move a sphere.
struct Moved {
    vec3 velocity;  // m/s
    vec3 move;        // m
};

float ownCount;
Moved ownMoved;

vec3 ahead(vec3 latest, vec3 before)
{
    return momentum == 0.0 ? latest : latest + (latest - before) * momentum;  // nobody may have written what was before
}

#if defined(FIRST) || defined(TEXTURES)
// Returns the row of what an entry touches, or NO_ROW: it rests.
int rowOfOther(int slot, int e)
{
    return rowOf(int(listsAt(slot, e)));
}

void loadOwnSphere(int slot)
{
    loadSphere(slot);
}
#else
int rowOfOther(int slot, int e)
{
    return int(partnerRowsAt(ownRow(slot), e));
}

// What is held is here as what rests: nothing moves it.
void loadOwnSphere(int slot)
{
    vec4 first = rowSpheresAt(ownRow(slot), 0);
    own.velocity = first.xyz;
    own.weight = first.w;
    own.radius = rowSpheresAt(ownRow(slot), 1).w;
    own.rests = own.weight == 0.0;
    ownBody = bodyOf(slot, own);
}
#endif

// Nobody moves what rests, and in fragments nobody writes how spheres move that move no others.
Moved movedAt(int row)
{
    if (inTextures && !SPREADS) {
        Sphere sphere = sphereAt(row);
        return Moved(sphere.velocity + ahead(totalsAt(row, 0).xyz, earlierTotalsAt(row, 0).xyz) * sphere.weight,
                     ahead(totalsAt(row, 1).xyz, earlierTotalsAt(row, 1).xyz) * sphere.weight);
    }
    if (row == NO_ROW) return Moved(vec3(0.0), vec3(0.0));
    return Moved(velocitiesAt(row, 0).xyz, velocitiesAt(row, 1).xyz);
}

void loadOwn(int slot)
{
    loadOwnSphere(slot);
    ownCount = effectiveCountOf(slot, own);
    ownMoved = movedAt(ownRow(slot));
}

// Returns that of a collider, a body of infinite mass, which does not ask whether it slides.
Constraint constrainCollider(NearCollider near)
{
    vec2 weights = stepWeights(weightsOf(own, ownBody, near.normal) * ownCount, ownCount);
    return Constraint(near.normal, partingSpeed(-near.gap, own.radius, false), weights, lacking(-near.gap, own.radius), near.friction);
}

// Returns the residual of a contact: by how much its relative velocity, as a part of that which is no impact, or its overlap, as a part of the
// radius, differs from what is asked where an iteration takes its impulse from the last two to `next`.
float residualOf(Constraint asked, vec4 next, vec4 push, vec4 before)
{
    vec3 change = next.xyz - ahead(push.xyz, before.xyz);
    float along = dot(change, asked.normal);
    float speed = max(abs(along) * asked.weights.x, length(change - along * asked.normal) * asked.weights.y);
    float move = (abs(next.w) - ahead(vec3(abs(push.w)), vec3(abs(before.w))).x) * asked.weights.x;
    return max(speed / max(restSpeed, 1e-20), abs(move) / own.radius);  // without gravity, of any speed a very large one
}

// Returns a contact's impulse after the iteration, from the last two; w of both: how far they push apart.
ContactImpulse solved(Constraint asked, Moved other, vec4 push, vec4 before)
{
    vec3 n = asked.normal;
    vec3 wanted = pairImpulse(ownMoved.velocity - other.velocity, n, asked.target, ahead(push.xyz, before.xyz), asked.weights);
    vec3 taken = withinFriction(wanted, n, asked.friction);
    float lacks = asked.lacks - dot(ownMoved.move - other.move, n);
    float apart = ahead(vec3(abs(push.w)), vec3(abs(before.w))).x + lacks / asked.weights.x;
    return ContactImpulse(taken, max(apart, 0.0), taken == wanted, vec3(0.0), 0.0, PERSISTENT);
}

// Returns the first part of a contact's impulse after the iteration. `row`: of the other sphere.
vec4 solve(int row, Constraint asked, vec4 push, vec4 before)
{
    if (asked.friction < 0.0) return vec4(0.0);
    return firstPart(solved(asked, movedAt(row), push, before));
}
