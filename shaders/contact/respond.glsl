// The impulses of all contacts of a slot at once (docs/contact.md), in stages, each a file:
//
//   prepare   what each contact remembers of the last step, and how many contacts act together
//   relax     one Jacobi iteration of all impulses, friction among them, and of what pushes overlaps apart
//   settle    how far the contacts move the spheres, and what they remember for the next step
//
// What contacts remember acts as a force over the step that follows (contact/apply.comp), so that what rests is at rest for any
// solver; the response finds only what is missing. A contact is an entry of both spheres' lists. Both work out the same for it,
// to the bit, from the same numbers: only gathers.
#include "contact/slot_sphere.glsl"

struct Entry {
    vec4 push;    // xyz impulse on this slot's sphere, N s; w how far it pushes the two apart, kg m, negative where it slides
    vec4 anchor;  // xyz from the other's centre to this one's when they began to stick, m; w the impulse that it may remember,
                  // N s; 0: it is an impact; negative: it takes no part
};

#ifdef BODIES
#include "contact/body_sums.glsl"

// Returns zeros for a sphere that gives way alone or not at all.
BodySphere bodyOf(int slot, Sphere sphere)
{
    if (sphere.rests) return BodySphere(vec3(0.0), 0.0, mat3(0.0), 0.0);
    return bodySphereAt(sphereOf(slot));
}
#endif

struct Meeting {
    Sphere sphere;  // the other
    vec3 apart;     // m, from its centre to this one's
    PairContact contact;
    bool meets;     // both lists hold it, or the other sphere rests and has none; and one of the two is free
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

#ifdef BODIES
vec2 weightsOf(Sphere sphere, BodySphere body, vec3 n)
{
    vec3 across = cross(body.arm, n);
    float turning = dot(across, body.perInertia * across);
    return sphere.weight + vec2(turning, max(body.turning - turning, 0.0));
}
#endif

// Returns what an impulse of 1 N s on this sphere changes of its velocity, 1/kg: x along the unit vector n, y across it, or more.
vec2 ownWeights(vec3 n)
{
#ifdef BODIES
    return weightsOf(own, ownBody, n);
#else
    return vec2(own.weight);
#endif
}

uniform UINTS effectiveCounts;  // by slot, as bits (contact/prepare.glsl)

// Among how many contacts what a sphere gives way is shared; one that rests gives none. 0: neither it nor its body touches another.
float shareOf(int slot, Sphere sphere)
{
    return sphere.rests ? 1.0 : uintBitsToFloat(fetch(effectiveCounts, slot).x);
}

// Returns what it changes of the two spheres' relative velocity. `shares`: among how many contacts each of the two is shared.
vec2 weightsBetween(Meeting with, vec3 n, vec2 shares)
{
    vec2 other = vec2(with.sphere.weight);
#ifdef BODIES
    other = weightsOf(with.sphere, with.body, n);
#endif
    return ownWeights(n) * shares.x + other * shares.y;
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

// Returns how large an impulse may be that the next step begins with, N s, of one that began with `start` and is `now`. What has
// stopped a fall is not what holds up what lies there, so memory takes in a tenth of what it has grown by, and where it carried
// little not much more than a weight. With half of it, molecules deep in a pile are shaken by what is remembered of their many
// contacts without balance. `weight`: 1/kg, of all that it moves.
float mostRemembered(float start, float now, float weight)
{
    return min(start + 0.1 * max(now - start, 0.0), 1.5 * start + restSpeed / weight);
}

// Returns an entry as the next step begins with it.
Entry remembered(Entry known, Sphere other)
{
    float start = known.anchor.w;
    float now = length(known.push.xyz);
    float most = start > 0.0 ? mostRemembered(start, now, own.weight + other.weight) : 0.0;
    known.push.xyz *= min(1.0, most / max(now, 1e-30));
    if (start > 0.0) known.anchor.w = length(known.push.xyz) + 1e-20;
    return known;
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
