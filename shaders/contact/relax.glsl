// The stage of contact/respond.glsl that is repeated.
#include "contact/respond.glsl"
#include "contact/totals.glsl"
#include "contact/shares.glsl"

uniform float momentum;     // Nesterov's: by how much of its last change an iteration goes on first
#ifdef SPREAD
uniform TOTALS motionsNow;  // contact/spread.glsl
#else
uniform TOTALS totals;
uniform TOTALS earlier;     // the same an iteration before
#endif

// An iteration takes a larger step towards several contacts at once than one that is certainly stable without momentum; a contact
// alone has its impulse at once.
const float overRelaxed = 1.3;
const float pushSpeed = 1.0;  // m/s: what overlaps is pushed apart no faster

float ownCount;
vec3 ownVelocity;
vec3 ownMove;

vec3 ahead(vec3 now, vec3 before)
{
    return momentum == 0.0 ? now : now + (now - before) * momentum;  // nobody may have written what was before
}

// m/s, as the impulses make it.
vec3 velocityOf(int slot, Sphere sphere)
{
#ifdef SPREAD
    return firstTotal(motionsNow, slot);
#else
    return sphere.velocity + ahead(firstTotal(totals, slot), firstTotal(earlier, slot)) * sphere.weight;
#endif
}

// m, by which shifts move the sphere.
vec3 moveOf(int slot, Sphere sphere)
{
#ifdef SPREAD
    return secondTotal(motionsNow, slot);
#else
    return ahead(secondTotal(totals, slot), secondTotal(earlier, slot)) * sphere.weight;
#endif
}

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = shareOf(slot, own);
    ownVelocity = velocityOf(slot, own);
    ownMove = moveOf(slot, own);
}

// m/s, at which a contact that rests is to part: what it may still close, or a little of what overlaps by more than half a percent.
float partingSpeed(float depth, float reach)
{
    return (min(depth, 0.0) + clamp(0.1 * (depth - 0.005 * reach), 0.0, 0.1 * stepTime)) / stepTime;
}

// 1/kg, by what the step is divided, along the normal and across it. `count`: of the contacts that are answered at once.
vec2 stepWeights(vec2 weights, float count)
{
    return isAlone(count) ? weights : weights / vec2(overRelaxed, overRelaxed * frictionStep);
}

// kg m, how far a contact pushes apart what still lacks so much, m.
float pushedApart(float now, float before, float lacks, float weight)
{
    return max(ahead(vec3(now), vec3(before)).x + lacks / weight, 0.0);
}

// Returns an entry's push after the iteration, from the last two. `n`: the contact's normal.
vec4 relax(int slot, int other, vec4 push, vec4 before, vec4 anchor, out vec3 n)
{
    Meeting with = meetingAs(slot, other, anchor);
    PairContact contact = with.contact;
    n = contact.normal;
    if (!with.meets) return vec4(0.0);
    vec2 shares = vec2(ownCount, shareOf(other, with.sphere));
    vec3 u = ownVelocity - velocityOf(other, with.sphere);
    float target = contact.impact ? -with.material.x * contact.speed
                                  : partingSpeed(contact.depth, own.radius + with.sphere.radius);
    vec2 weights = stepWeights(weightsBetween(with, n, shares), max(shares.x, shares.y));
    vec3 wanted = pairImpulse(u, n, target, ahead(push.xyz, before.xyz), weights);
    vec3 taken = withinFriction(wanted, n, with.material.y);
    float lacks = min(contact.depth, pushSpeed * stepTime) - dot(ownMove - moveOf(other, with.sphere), n);
    float apart = contact.impact ? 0.0 : pushedApart(abs(push.w), abs(before.w), lacks, weights.x);
    return vec4(taken, taken == wanted ? apart : -max(apart, 1e-30));
}

#ifdef WALLS
#include "contact/near_walls.glsl"

// Returns a collider's push after the iteration: a body of infinite mass, which does not ask whether it slides.
vec4 relaxWall(Wall wall, vec4 push, vec4 before)
{
    vec3 n = wall.normal;
    vec3 u = ownVelocity - wall.velocity;
    vec2 weights = stepWeights(ownWeights(n) * ownCount, ownCount);
    vec3 wanted = pairImpulse(u, n, partingSpeed(-wall.gap, own.radius), ahead(push.xyz, before.xyz), weights);
    float lacks = min(-wall.gap, pushSpeed * stepTime) - dot(ownMove, n);
    float apart = pushedApart(push.w, before.w, lacks, weights.x);
    return vec4(withinFriction(wanted, n, wall.friction), apart);
}
#endif
