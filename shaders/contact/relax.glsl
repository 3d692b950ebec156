// The stage of contact/respond.glsl that is repeated.
#include "contact/respond.glsl"
#include "contact/constraint.glsl"
#include "contact/totals.glsl"
#include "contact/shares.glsl"

#ifdef FIRST
const float momentum = 0.0;
#else
uniform float momentum;     // Nesterov's: by how much of its last change an iteration goes on first
#endif
uniform TOTALS totals;      // of the last iteration
uniform TOTALS earlier;     // of the one before
uniform TOTALS motionsNow;  // m/s and m, by slot, as the last iteration leaves them and the momentum of this one takes them on

// How impulses and shifts so far, and the iteration's momentum, move a sphere.
struct Moved {
    vec3 velocity;  // m/s
    vec3 by;        // m
};

float ownCount;
Moved ownMoved;

vec3 ahead(vec3 now, vec3 before)
{
    return momentum == 0.0 ? now : now + (now - before) * momentum;  // nobody may have written what was before
}

Moved movedAt(int slot)
{
#ifdef SPREAD
    return Moved(firstTotal(motionsNow, slot), secondTotal(motionsNow, slot));
#elif defined(TEXTURES) || defined(FIRST)
    Sphere sphere = sphereAt(slot);
    return Moved(sphere.velocity + ahead(firstTotal(totals, slot), firstTotal(earlier, slot)) * sphere.weight,
                 ahead(secondTotal(totals, slot), secondTotal(earlier, slot)) * sphere.weight);
#else
#ifdef RESTING
    if (isResting(fetch(cells, slot).w, fetch(marks, slot).x)) return Moved(vec3(0.0), vec3(0.0));
#endif
    return Moved(firstTotal(motionsNow, slot), secondTotal(motionsNow, slot));
#endif
}

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = shareOf(slot, own);
    ownMoved = movedAt(slot);
}

// kg m, how far a contact pushes apart what still lacks so much, m.
float pushedApart(float now, float before, float lacks, float weight)
{
    return max(ahead(vec3(now), vec3(before)).x + lacks / weight, 0.0);
}

// Returns an entry's push after the iteration, from the last two.
vec4 relax(int other, Constraint asked, vec4 push, vec4 before)
{
    if (asked.friction < 0.0) return vec4(0.0);
    vec3 n = asked.normal;
    Moved moved = movedAt(other);
    vec3 u = ownMoved.velocity - moved.velocity;
    vec3 wanted = pairImpulse(u, n, asked.target, ahead(push.xyz, before.xyz), asked.weights);
    vec3 taken = withinFriction(wanted, n, asked.friction);
    float apart = pushedApart(abs(push.w), abs(before.w), asked.lacks - dot(ownMoved.by - moved.by, n), asked.weights.x);
    return vec4(taken, taken == wanted ? apart : -max(apart, 1e-30));
}

#ifdef WALLS
#include "contact/near_walls.glsl"

// Returns a collider's push after the iteration: a body of infinite mass, which does not ask whether it slides.
vec4 relaxWall(Wall wall, vec4 push, vec4 before)
{
    vec3 n = wall.normal;
    vec3 u = ownMoved.velocity - wall.velocity;
    vec2 weights = stepWeights(ownWeights(n) * ownCount, ownCount);
    vec3 wanted = pairImpulse(u, n, partingSpeed(-wall.gap, own.radius), ahead(push.xyz, before.xyz), weights);
    float lacks = lacking(-wall.gap, own.radius) - dot(ownMoved.by, n);
    float apart = pushedApart(push.w, before.w, lacks, weights.x);
    return vec4(withinFriction(wanted, n, wall.friction), apart);
}
#endif
