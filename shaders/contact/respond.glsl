// The impulses of all contacts of a slot at once (docs/contact.md), in stages, each a file:
//
//   prepare   what each contact remembers of the last step, and how many contacts act together
//   relax     one Jacobi iteration of all impulses, friction among them, and of what pushes overlaps apart
//   settle    how far the contacts move the spheres, and what they remember for the next step
//
// What contacts remember acts as a force over the step that follows (contact/apply.comp), so that what rests is at rest for any
// solver; the response finds only what is missing. A contact is an entry of both spheres' lists. Both work out the same for it,
// to the bit, from the same numbers: only gathers.
#include "contact/response.glsl"

struct Entry {
    vec4 push;    // xyz impulse on this slot's sphere, N s; w how far it pushes the two apart, kg m, negative where it slides
    vec4 anchor;  // xyz from the other's centre to this one's when they began to stick, m; w the impulse that it may remember,
                  // N s; 0: it is an impact; negative: it takes no part
};

#ifdef BODIES
#include "contact/body_sums.glsl"

uniform int rigidGroups;  // a bit each

BodySphere bodyOf(int slot, Sphere sphere)
{
    if (sphere.rests || (rigidGroups >> int(sphere.label >> 26u) & 1) == 0) return BodySphere(vec3(0.0), 0.0, mat3(0.0));
    return bodySphereAt(sphereOf(slot));
}

// Returns by how much an impulse of 1 N s along the unit vector n changes the sphere's velocity along it by turning its body, 1/kg.
float turningOf(BodySphere body, vec3 n)
{
    vec3 across = cross(body.arm, n);
    return dot(across, body.perInertia * across);
}
#endif

// Returns what the next step begins with, N s. An impulse that has stopped what came is not what holds up what lies there, so
// memory takes in only a part of what an impulse has grown by.
vec3 remembered(Entry known)
{
    float now = length(known.push.xyz);
    float limit = known.anchor.w + 0.5 * max(now - known.anchor.w, 0.0);
    return known.anchor.w > 0.0 ? known.push.xyz * min(1.0, limit / max(now, 1e-30)) : vec3(0.0);
}

struct Meeting {
    Sphere sphere;  // the other
    vec3 apart;     // m, from its centre to this one's
    PairContact contact;
    bool meets;     // both lists hold it, and one of the spheres is free
    vec2 material;  // x restitution, y friction
#ifdef BODIES
    BodySphere body;
#endif
};

Sphere own;
#ifdef BODIES
BodySphere ownBody;
#endif

void loadSphere(int slot)
{
    own = sphereAt(slot);
#ifdef BODIES
    ownBody = bodyOf(slot, own);
#endif
}

// Returns by how much an impulse of 1 N s along the unit vector n changes this sphere's velocity along it, 1/kg.
float ownWeightAlong(vec3 n)
{
#ifdef BODIES
    return own.weight + turningOf(ownBody, n);
#else
    return own.weight;
#endif
}

// Returns by how much it changes the spheres' relative velocity. `shares`: among how many contacts each of the two is shared.
float weightAlong(Meeting with, vec3 n, vec2 shares)
{
    float other = with.sphere.weight;
#ifdef BODIES
    other += turningOf(with.body, n);
#endif
    return ownWeightAlong(n) * shares.x + other * shares.y;
}

// Returns which part of the way that this sphere gives is the turning of its body.
float turningPart(vec3 n)
{
#ifdef BODIES
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
    with.meets = own.weight + with.sphere.weight > 0.0 && (with.sphere.rests || holds(other, slot));
    with.material = materialOf(own, with.sphere);
#ifdef BODIES
    with.body = bodyOf(other, with.sphere);
#endif
    return with;
}

bool isDeep(PairContact contact, float reach)
{
    return contact.depth > 0.25 * reach;
}

// Where spheres have sunk deep into one another, the way out is that by which they came in.
void leaveAsCome(inout Meeting with, vec3 anchor)
{
    float reach = own.radius + with.sphere.radius;
    if (with.contact.impact || !isDeep(with.contact, reach)) return;
    vec3 n = anchor / max(length(anchor), 1e-30);
    with.contact.normal = n;
    with.contact.depth = reach - dot(with.apart, n);
    with.contact.speed = dot(own.velocity - with.sphere.velocity, n);
}

// The meeting of an entry whose anchor prepare() has left.
Meeting meetingAs(int slot, int other, vec4 anchor)
{
    Meeting with = meetingOf(slot, other, anchor.w > 0.0 ? 1e30 : restSpeed);
    with.meets = with.meets && anchor.w >= 0.0;
    leaveAsCome(with, anchor.xyz);
    return with;
}
