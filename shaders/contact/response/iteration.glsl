// One Jacobi iteration of the impulse of a contact, from the last two. Needs `momentum`, Nesterov's: by how much of its last change an
// iteration goes on first.
#include "contact/response/pair.glsl"
#include "contact/response/constraint.glsl"
#pragma reads impulses earlierImpulses totals earlierTotals velocities

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

// Nobody writes the velocity of what rests, and fragments only those of spheres that move others.
Moved movedAt(int slot)
{
    if (inTextures && !SPREADS) {
        Sphere sphere = sphereAt(slot);
        return Moved(sphere.velocity + ahead(totalsAt(slot, 0).xyz, earlierTotalsAt(slot, 0).xyz) * sphere.weight,
                     ahead(totalsAt(slot, 1).xyz, earlierTotalsAt(slot, 1).xyz) * sphere.weight);
    }
    if (rests(slot)) return Moved(vec3(0.0), vec3(0.0));
    return Moved(velocitiesAt(slot, 0).xyz, velocitiesAt(slot, 1).xyz);
}

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = effectiveCountOf(slot, own);
    ownMoved = movedAt(slot);
}

struct Push {
    vec3 impulse;  // N s
    float apart;   // kg m, how far it pushes apart
    bool sticks;
};

// Returns a contact's impulse after the iteration, from the last two; w of both: how far they push apart.
Push solved(Constraint asked, Moved other, vec4 push, vec4 before)
{
    vec3 n = asked.normal;
    vec3 wanted = pairImpulse(ownMoved.velocity - other.velocity, n, asked.target, ahead(push.xyz, before.xyz), asked.weights);
    vec3 taken = withinFriction(wanted, n, asked.friction);
    float lacks = asked.lacks - dot(ownMoved.move - other.move, n);
    float apart = ahead(vec3(abs(push.w)), vec3(abs(before.w))).x + lacks / asked.weights.x;
    return Push(taken, max(apart, 0.0), taken == wanted);
}

// Returns the first part of a contact's impulse after the iteration.
vec4 solve(int other, Constraint asked, vec4 push, vec4 before)
{
    if (asked.friction < 0.0) return vec4(0.0);
    Push next = solved(asked, movedAt(other), push, before);
    return firstPart(ContactImpulse(next.impulse, next.apart, next.sticks, vec3(0.0), 0.0, PERSISTENT));
}
