// The stage of contact/respond.glsl that is repeated: one Jacobi iteration of all impulses, friction among them.

#include "contact/respond.glsl"

uniform UINTS effectiveCounts;  // by slot, as bits
uniform FLOATS earlier;         // N s, the same an iteration before
uniform float momentum;         // Nesterov's: by how much of its last change an iteration goes on first
uniform FLOATS impulses;        // N s, by slot: what its contacts have exchanged beside what they remember
uniform FLOATS known;           // N s, by slot: the sum of what they remember, which has acted as a force over the step
#ifdef SPREAD
uniform FLOATS velocities;      // m/s, with these impulses: contact/spread.glsl
#endif

uniform FLOATS shifts;          // kg m, by slot: what pushes apart what overlaps
uniform FLOATS earlierShifts;
#ifdef SPREAD
uniform FLOATS moves;           // m, what these make of the spheres' places
#endif

const float pushSpeed = 1.0;    // m/s: what overlaps is pushed apart no faster

float ownCount;
vec3 ownVelocity;
vec3 ownMove;

vec3 ahead(vec3 now, vec3 before)
{
    return now + (now - before) * momentum;
}

// m/s, as the impulses make it.
vec3 velocityOf(int slot, Sphere sphere)
{
#ifdef SPREAD
    return fetch(velocities, slot).xyz;
#else
    return sphere.velocity + ahead(fetch(impulses, slot).xyz, fetch(earlier, slot).xyz) * sphere.weight;
#endif
}

// m, by which shifts move the sphere.
vec3 moveOf(int slot, Sphere sphere)
{
#ifdef SPREAD
    return fetch(moves, slot).xyz;
#else
    return ahead(fetch(shifts, slot).xyz, fetch(earlierShifts, slot).xyz) * sphere.weight;
#endif
}

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = uintBitsToFloat(fetch(effectiveCounts, slot).x);
    ownVelocity = velocityOf(slot, own);
    ownMove = moveOf(slot, own);
}

// Returns the entry's `push` after the iteration, from the last two.
vec4 relax(int slot, int other, vec4 push, vec3 before, vec4 anchor, vec2 parted, out float parts, out vec3 shift)
{
    Meeting with = meetingAs(slot, other, anchor);
    PairContact contact = with.contact;
    vec2 shares = vec2(ownCount, uintBitsToFloat(fetch(effectiveCounts, other).x));
    vec3 u = ownVelocity - velocityOf(other, with.sphere);
    float target = contact.impact ? -with.material.x * contact.speed : (min(with.contact.depth, 0.0) + clamp(0.1 * (with.contact.depth - 0.01 * (own.radius + with.sphere.radius)), 0.0, 0.1 * stepTime)) / stepTime;
    vec3 n = contact.normal;
    vec3 across = u - n * dot(u, n);
    vec3 slip = across / max(length(across), 1e-30);
    vec2 weight = vec2(weightAlong(with, n, shares), max(weightAlong(with, slip, shares), dot(vec2(own.weight, with.sphere.weight), shares)));
    vec3 wanted = pairImpulse(u, n, target, ahead(push.xyz, before), weight, 1.6);
    vec3 taken = with.meets ? withinFriction(wanted, contact.normal, with.material.y) : vec3(0.0);
    float depth = min(contact.depth, pushSpeed * stepTime);
    float lacks = depth - dot(ownMove - moveOf(other, with.sphere), n);
    parts = with.meets && !contact.impact ? max(parted.x + (parted.x - parted.y) * momentum + 1.6 * lacks / weight.x, 0.0) : 0.0;
    shift = n * parts;
    uint bits = floatBitsToUint(push.w) & SPHERE;
    if (contact.impact) bits |= IMPACT;
    if (taken != wanted) bits |= SLIDES;
    return vec4(taken, uintBitsToFloat(bits));
}

#ifdef WALLS
#include "contact/walls.glsl"

// The same of a collider, a body of infinite mass.
vec4 relaxWall(Wall wall, vec4 push, vec4 before)
{
    vec3 n = wall.normal;
    vec3 u = ownVelocity - wall.velocity;
    vec3 across = u - n * dot(u, n);
    vec2 weight = vec2(ownWeightAlong(n), max(ownWeightAlong(across / max(length(across), 1e-30)), own.weight));
    vec3 wanted = pairImpulse(u, n, -wall.gap / stepTime, ahead(push.xyz, before.xyz), weight, 1.6 / ownCount);
    float lacks = -wall.gap - dot(ownMove, n);
    float part = max(push.w + (push.w - before.w) * momentum + 1.6 * lacks / (weight.x * ownCount), 0.0);
    return vec4(withinFriction(wanted, n, wall.friction), part);
}
#endif
