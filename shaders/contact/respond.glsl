// The impulses of all contacts of a slot at once (docs/contact.md), in stages, each a file:
//
//   guess       where spheres rest on one another, a first guess from how far they overlap
//   relax       one Jacobi iteration towards each contact's speed after it: -e times that of the impact, or none
//   friction    Coulomb friction, in a few rounds, and how far all of it moves the spheres
//   correction  spheres that are pushed apart while they sink keep that as velocity, so that a pile does not fall for ever
//
// A stage defines respond(), storeMore() for what it leaves beside its impulses and, with WALLS, respondToWall(), as to a
// contact with a body of infinite mass.
//
// Only gathers: both spheres of a contact compute its impulse, to the same bit, from the same numbers. `impulses` are
// totals; what a slot without contact has there is undefined and never read.
#include "contact/response.glsl"

uniform UINTS effectiveCounts;  // by slot, as bits (contact/effective.glsl)
#ifdef TRIANGLES
uniform FLOATS velocities;      // written by contact/spread.comp
#endif
uniform FLOATS impulses;        // N s, of the last stage
uniform FLOATS earlier;         // of the one before
uniform float momentum;         // Nesterov's, the share of the last change by which an iteration extrapolates
uniform float frictionShare;    // of what friction may do, in one of several rounds
#ifdef WALLS
#include "contact/walls.glsl"

uniform FLOATS wallFriction;  // x friction, by group
#ifdef TEXTURES
float wallPush = 0.0;  // N s, what the stage leaves: the w of its impulses

vec2 wallPushesOf(int slot)
{
    return vec2(fetch(impulses, slot).w, fetch(earlier, slot).w);
}

void storeWallPush(int slot, vec2 pushes)
{
    wallPush = pushes.x;
}
#else
layout(std430, binding = 4) buffer WallPushed { vec2 wallPushed[]; };

// N s: x now, y an iteration before.
vec2 wallPushesOf(int slot)
{
    return wallPushed[slot];
}

void storeWallPush(int slot, vec2 pushes)
{
    wallPushed[slot] = pushes;
}
#endif
#endif

// N s, of each entry of the lists: x now, y an iteration before.
#ifdef TEXTURES
uniform sampler2DArray pushed;
uniform sampler2DArray pushedBefore;
vec4 stored[LIST / 4];  // what the stage leaves beside its impulses

vec2 pushesOf(int slot, int e)
{
    ivec3 entry = ivec3(texelOf(slot), e >> 2);
    return vec2(texelFetch(pushed, entry, 0)[e & 3], texelFetch(pushedBefore, entry, 0)[e & 3]);
}

void storePushes(int slot, int e, vec2 pushes)
{
    stored[e >> 2][e & 3] = pushes.x;
}
#else
layout(std430, binding = 1) buffer Pushed { vec2 pushed[]; };

vec2 pushesOf(int slot, int e)
{
    return pushed[e * listStride + slot];
}

void storePushes(int slot, int e, vec2 pushes)
{
    pushed[e * listStride + slot] = pushes;
}
#endif

// respond() sets these for the slot that it is called with.
Sphere own;
float ownCount;
vec3 ownVelocity;
vec3 impulse = vec3(0.0);

void loadOwn(int slot)
{
    own = sphereAt(slot);
    ownCount = uintBitsToFloat(fetch(effectiveCounts, slot).x);
}

vec3 impulseOf(int slot)
{
    return fetch(impulses, slot).xyz;
}

// m/s, as the total of its impulses makes it.
vec3 velocityOf(int slot, Sphere sphere, vec3 total)
{
#ifdef TRIANGLES
    return fetch(velocities, slot).xyz;
#else
    return sphere.velocity + total * sphere.weight;
#endif
}

struct Meeting {
    Sphere sphere;     // the other
    PairContact contact;
    bool meets;
    float weight;      // 1/kg, of both
    float share;       // of the impulse that it would take alone
    float correction;  // kg m, of the penetration
};

Meeting meetingOf(int slot, int other)
{
    Sphere sphere = sphereAt(other);
    float weight = own.weight + sphere.weight;
    PairContact contact = contactOf(own, sphere, slot < other ? 1.0 : -1.0);
    bool meets = weight > 0.0 && holds(other, slot);
    float share = 1.0 / max(ownCount, uintBitsToFloat(fetch(effectiveCounts, other).x));
    float correction = contact.impact ? 0.0 : share * contact.depth / max(weight, 1e-30);
    return Meeting(sphere, contact, meets, weight, share, correction);
}
