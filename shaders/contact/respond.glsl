// The impulses of all contacts of a slot at once (docs/contact.md). In the order of the stages:
//
//   CROWD    by how much the contacts of a sphere together outdo one alone
//   BEGIN    where spheres rest on one another, a first guess from how far they overlap
//   RELAX    one Jacobi iteration towards each contact's speed after it: -e times that of the impact, or none
//   SETTLE   Coulomb friction, in a few rounds, and how far all of it moves the spheres
//   KEEP     spheres that are pushed apart while they sink keep that as velocity, so that a pile does not fall for ever
//
// Only gathers: both spheres of a contact compute its impulse, to the same bit, from the same numbers. `impulses` are
// totals; what a slot without contact has there is undefined and never read.
#include "contact/records.glsl"
#include "contact/lists.glsl"
#ifndef CROWD
#include "contact/velocity.glsl"
#endif
#include "physics/pair.glsl"

#ifndef CROWD
uniform UINTS crowds;        // by slot, as bits: the largest eigenvalue of its contacts' normals, or more
#endif
uniform FLOATS materials;    // x restitution, y friction, by group * groupCount + group
uniform int groupCount;
uniform float stepTime;      // s, of a contact step
uniform float restSpeed;     // m/s
uniform float rubShare;      // of what friction may do, in one of several rounds of SETTLE
#ifdef KEEP
uniform FLOATS kept;         // w: of shifts
#endif

// N s, of each entry of the lists: x now, y an iteration before.
#ifndef CROWD
#ifdef TEXTURES
uniform sampler2DArray pushed;
uniform sampler2DArray pushedBefore;
vec4 newPushes[LIST / 4];

vec2 pushesOf(int slot, int e)
{
    ivec3 entry = ivec3(texelOf(slot), e >> 2);
    return vec2(texelFetch(pushed, entry, 0)[e & 3], texelFetch(pushedBefore, entry, 0)[e & 3]);
}

void keepPushes(int slot, int e, vec2 pushes)
{
    newPushes[e >> 2][e & 3] = pushes.x;
}
#else
layout(std430, binding = 1) buffer Pushed { vec2 pushed[]; };

vec2 pushesOf(int slot, int e)
{
    return pushed[e * listStride + slot];
}

void keepPushes(int slot, int e, vec2 pushes)
{
    pushed[e * listStride + slot] = pushes;
}
#endif
#endif

// Whether the list of a slot holds another: one that is full may not, and then neither takes the contact.
bool holds(int slot, int other)
{
    int listed = int(fetch(counts, slot).x);
    bool found = listed <= LIST;
    int e = found ? LIST : 0;
    while (e < LIST) {
        found = found || entryOf(slot, e) == other;
        ++e;
    }
    return found;
}

// Contacts that friction shares a sphere with, the wall among them.
int numberOf(int slot)
{
    return int(fetch(counts, slot).x) + 1;
}

// respond() sets these for the slot that it is called with.
uint ownLabel;
float ownWeight;
vec3 impulse = vec3(0.0);
#ifdef CROWD
NormalSum normalSum = NormalSum(vec3(0.0), vec3(0.0));
#else
float ownCrowd;
#endif
#if defined(RELAX) || defined(SETTLE)
vec3 ownVelocity;
#endif
#ifdef SETTLE
vec3 shift = vec3(0.0);
vec3 rest = vec3(0.0);
#endif

void respond(int slot, int listed)
{
    uvec4 ownRecord = fetch(places, slot);
    uvec4 ownMotion = fetch(motions, motionOf(slot));
    vec3 ownPlace = uintBitsToFloat(ownRecord.xyz);
    vec3 ownStart = uintBitsToFloat(ownMotion.xyz);
    float ownRadius = uintBitsToFloat(fetch(cells, slot).w);
    ownLabel = ownRecord.w;
    ownWeight = uintBitsToFloat(ownMotion.w);
#ifndef CROWD
    ownCrowd = uintBitsToFloat(fetch(crowds, slot).x);
#endif
#ifdef KEEP
    impulse = impulseOf(slot);
    float ownKept = fetch(kept, slot).w;
#endif
#if defined(RELAX) || defined(SETTLE)
    ownVelocity = velocityOf(slot, ownStart, ownWeight);
    impulse = impulseOf(slot);
#endif
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        uvec4 place = fetch(places, other);
        uvec4 motion = fetch(motions, motionOf(other));
        vec3 start = uintBitsToFloat(motion.xyz);
        float weight = uintBitsToFloat(motion.w);
        float w = ownWeight + weight;
        float reach = ownRadius + uintBitsToFloat(fetch(cells, other).w);
        PairContact contact = pairContact(localDifference(ownPlace, uintBitsToFloat(place.xyz), cell),
                                          ownStart - start, reach, stepTime, restSpeed, slot < other ? 1.0 : -1.0);
        bool meets = w > 0.0 && holds(other, slot);
#ifdef CROWD
        if (meets) normalSum = withNormal(normalSum, contact.normal);
#else
        float share = 1.0 / max(ownCrowd, uintBitsToFloat(fetch(crowds, other).x));
        float push = contact.impact ? 0.0 : share * contact.depth / max(w, 1e-30);
        vec2 material = fetch(materials, int(ownLabel >> 26u) * groupCount + int(place.w >> 26u)).xy;
#ifdef BEGIN
        float total = meets ? push / stepTime : 0.0;
        keepPushes(slot, e, vec2(total));
        impulse += contact.normal * total;
#elif defined(KEEP)
        float part = min(ownKept, fetch(kept, other).w);
        impulse += meets ? contact.normal * (push / stepTime * part) : vec3(0.0);
#else
        vec3 relative = ownVelocity - velocityOf(other, start, weight);
        float speed = dot(relative, contact.normal);
        vec2 pushes = pushesOf(slot, e);
#ifdef RELAX
        float before = max(pushes.x + (pushes.x - pushes.y) * momentum, -1e30);
        float target = contact.impact ? -material.x * contact.speed : max(contact.speed, 0.0);
        float change = meets ? pairImpulse(speed, target, before, w, share) : 0.0;
        keepPushes(slot, e, vec2(before + change, pushes.x));
        impulse += contact.normal * change;
#else
        vec3 along = relative - contact.normal * speed;
        float slip = length(along);
        float before = pushes.x;
        float most = 1.5 / float(max(numberOf(slot), numberOf(other)));
        float grip = min(material.y * before * rubShare, most * slip / w);
        // A pair alone needs no rounds: all that its spheres have exchanged besides the push is friction.
        bool alone = isAlone(share);
        float rubbed = length(impulse - contact.normal * before);
        grip = alone ? min(max(material.y * before - rubbed, 0.0), slip / w) : grip;
        vec3 rub = along * (meets ? -grip / max(slip, 1e-30) : 0.0);
        impulse += rub;
        vec3 bounce = (alone ? impulse : contact.normal * before + rub) * contact.since;
        shift += meets && contact.impact ? bounce : vec3(0.0);
        rest += meets ? contact.normal * push : vec3(0.0);
#endif
#endif
#endif
    }
}

#ifdef SETTLE
// xyz kg m, how far it moves; w how much of its push it keeps.
vec4 shiftOf()
{
    vec3 change = rest * (ownWeight / stepTime);
    return vec4(shift + rest, clamp(-dot(ownVelocity, change) / max(dot(change, change), 1e-30), 0.0, 1.0));
}
#endif
