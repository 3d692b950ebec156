// The impulses of all contacts of a slot (docs/contact.md), in stages, each a file:
//
//   prepare   what each contact remembers of the last step, and how many contacts act together
//   relax     one Jacobi iteration of all impulses, friction among them
//   settle    how far the contacts move the spheres, and what they remember for the next step
//
// A contact is an entry of both spheres' lists. Both compute its impulse, to the same bit, from the same numbers: only gathers.
#include "contact/response.glsl"

// Flags beside the number of the other sphere.
const uint IMPACT = 0x80000000u;  // nothing of the contact is remembered
const uint SLIDES = 0x40000000u;  // the place where it sticks is not
const uint SPHERE = 0x3fffffffu;

struct Entry {
    vec4 push;    // xyz impulse on this slot's sphere, N s; w as bits: the other sphere, and flags
    vec4 anchor;  // xyz from the other's centre to this one's when they began to stick, m; w how large an impulse it may remember, N s
};

#ifdef SPREAD
#include "contact/body_sums.glsl"

uniform int rigidGroups;  // a bit each

BodySphere bodyOf(int slot, Sphere sphere)
{
    if ((rigidGroups >> int(sphere.label >> 26u) & 1) == 0) return BodySphere(vec3(0.0), 0.0, mat3(0.0));
    return bodySphereAt(sphereOf(slot));
}

// What an impulse of 1 N s along the unit vector n changes of the sphere's velocity along it by turning its body.
float turningOf(BodySphere body, vec3 n)
{
    vec3 across = cross(body.arm, n);
    return dot(across, body.perInertia * across);
}
#endif

// What the next step begins with. An impulse that has stopped what came is not what holds up what lies there: memory grows by
// what gravity adds in a step or two, and no faster.
const float ALPHA = 0.5;
vec3 remembered(Entry known)
{
    if ((floatBitsToUint(known.push.w) & IMPACT) != 0u) return vec3(0.0);
    float now = length(known.push.xyz);
    float limit = known.anchor.w + ALPHA * max(now - known.anchor.w, 0.0);
    return known.push.xyz * min(1.0, limit / max(now, 1e-30));
}

struct Meeting {
    Sphere sphere;  // the other
    vec3 apart;     // m, from its centre to this one's
    PairContact contact;
    bool meets;     // both lists hold it, and one of the spheres is free
#ifdef SPREAD
    BodySphere body;
#endif
    vec2 material;  // x restitution, y friction
};

Sphere own;
#ifdef SPREAD
BodySphere ownBody;
#endif

void loadSphere(int slot)
{
    own = sphereAt(slot);
#ifdef SPREAD
    ownBody = bodyOf(slot, own);
#endif
}

// 1/kg: what an impulse of 1 N s along the unit vector n changes of this sphere's velocity along it.
float ownWeightAlong(vec3 n)
{
#ifdef SPREAD
    return own.weight + turningOf(ownBody, n);
#else
    return own.weight;
#endif
}

// The same of the spheres' relative velocity.
// `shares`: among how many contacts either sphere is shared.
float weightAlong(Meeting with, vec3 n, vec2 shares)
{
    float other = with.sphere.weight;
#ifdef SPREAD
    other += turningOf(with.body, n);
#endif
    return ownWeightAlong(n) * shares.x + other * shares.y;
}

// The part of it that is the turning of this sphere's body, of what this sphere's gives way.
float turningPart(vec3 n)
{
#ifdef SPREAD
    float turning = turningOf(ownBody, n);
    return turning / max(own.weight + turning, 1e-30);
#else
    return 0.0;
#endif
}

// `bounceFrom`: m/s; slower is no impact.
Meeting meetingOf(int slot, int other, float bounceFrom)
{
    Meeting with;
    with.sphere = sphereAt(other);
    with.apart = localDifference(own.place, with.sphere.place, cell);
    with.contact = pairContact(with.apart, own.velocity - with.sphere.velocity, own.radius + with.sphere.radius, stepTime,
                               bounceFrom, slot < other ? 1.0 : -1.0);
#ifdef SPREAD
    with.body = bodyOf(other, with.sphere);
#endif
    with.meets = own.weight + with.sphere.weight > 0.0 && holds(other, slot);
    with.material = materialOf(own, with.sphere);
    return with;
}

// Where spheres have sunk deep into one another, the way out is that by which they came in.
const float deepPart = 0.25;  // of the sum of the radii

bool isDeep(PairContact contact, float reach)
{
    return contact.depth > deepPart * reach;
}

void leaveAsCome(inout Meeting with, vec3 anchor)
{
    float reach = own.radius + with.sphere.radius;
    if (with.contact.impact || !isDeep(with.contact, reach)) return;
    vec3 n = anchor / max(length(anchor), 1e-30);
    with.contact.normal = n;
    with.contact.depth = reach - dot(with.apart, n);
    with.contact.speed = dot(own.velocity - with.sphere.velocity, n);
}

// An entry as prepare() has left its anchor: w 0 is an impact, below 0 takes no part.
Meeting meetingAs(int slot, int other, vec4 anchor)
{
    Meeting with = meetingOf(slot, other, anchor.w > 0.0 ? 1e30 : restSpeed);
    with.meets = with.meets && anchor.w >= 0.0;
    leaveAsCome(with, anchor.xyz);
    return with;
}
