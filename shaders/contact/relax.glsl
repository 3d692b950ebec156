// The stage of contact/respond.glsl that is repeated.
#include "contact/respond.glsl"
#include "contact/constraint.glsl"
#include "contact/totals.glsl"

#ifdef FIRST
const float momentum = 0.0;
#else
uniform float momentum;     // Nesterov's: by how much of its last change an iteration goes on first
#endif
uniform TOTALS totals;      // of the last iteration
uniform TOTALS earlier;     // of the one before
uniform TOTALS motionsNow;  // by slot: Moved; nobody writes those of what rests

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
#if defined(TEXTURES) && !defined(SPREAD)
    Sphere sphere = sphereAt(slot);
    return Moved(sphere.velocity + ahead(firstTotal(totals, slot), firstTotal(earlier, slot)) * sphere.weight,
                 ahead(secondTotal(totals, slot), secondTotal(earlier, slot)) * sphere.weight);
#else
    if (rests(slot)) return Moved(vec3(0.0), vec3(0.0));
    return Moved(firstTotal(motionsNow, slot), secondTotal(motionsNow, slot));
#endif
}

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = shareOf(slot, own);
    ownMoved = movedAt(slot);
}

struct Push {
    vec3 impulse;  // N s
    float apart;   // kg m, how far it pushes apart
    bool sticks;
};

// Returns a contact's push after the iteration, from the last two.
Push relaxed(Constraint asked, Moved other, vec4 push, vec4 before)
{
    vec3 n = asked.normal;
    vec3 wanted = pairImpulse(ownMoved.velocity - other.velocity, n, asked.target, ahead(push.xyz, before.xyz), asked.weights);
    vec3 taken = withinFriction(wanted, n, asked.friction);
    float lacks = asked.lacks - dot(ownMoved.by - other.by, n);
    float apart = ahead(vec3(abs(push.w)), vec3(abs(before.w))).x + lacks / asked.weights.x;
    return Push(taken, max(apart, 0.0), taken == wanted);
}

// Returns an entry's push after the iteration, as Entry::push.
vec4 relax(int other, Constraint asked, vec4 push, vec4 before)
{
    if (asked.friction < 0.0) return vec4(0.0);
    Push next = relaxed(asked, movedAt(other), push, before);
    return vec4(next.impulse, next.sticks ? next.apart : -max(next.apart, 1e-30));
}

#ifdef WALLS
#include "contact/near_walls.glsl"

// Returns a collider's push after the iteration: a body of infinite mass, which does not ask whether it slides.
vec4 relaxWall(Wall wall, vec4 push, vec4 before)
{
    if (ownCount <= 0.0) return vec4(0.0);
    vec2 weights = stepWeights(ownWeights(wall.normal) * ownCount, ownCount);
    Constraint asked = Constraint(wall.normal, partingSpeed(-wall.gap, own.radius), weights, lacking(-wall.gap, own.radius),
                                  wall.friction);
    Push next = relaxed(asked, Moved(wall.velocity, vec3(0.0)), push, before);
    return vec4(next.impulse, next.apart);
}
#endif
