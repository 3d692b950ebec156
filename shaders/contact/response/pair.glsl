// The contacts of a slot, pair by pair, for the stages of the response (docs/contact.md):
//
//   prepare   the impulse with which each contact begins, and how many contacts act together
//   solve     one Jacobi iteration of all impulses, friction among them, and of what pushes overlaps apart
//   store     how far the contacts move the spheres, and what they remember for the next step
//
// The impulses that contacts remember act as a force over the step that follows (contact/response/apply.pass.glsl), so that what rests is at rest for
// any solver; the response finds only what is missing. A contact is an entry of both spheres' lists. Both work out the same for it,
// to the bit, from the same numbers: only gathers.
#include "contact/search/responding.glsl"
#include "contact/slots.glsl"
#include "contact/response/impulse.glsl"
#include "contact/response/body.glsl"
#include "contact/grid/colliders.glsl"
#include "physics/pair.glsl"
#pragma reads counts lists materials

uniform int groupCount;

const float pushSpeed = 1.0;  // m/s: what overlaps is pushed apart no faster

struct Sphere {
    vec3 place;     // m, local (physics/cells.glsl)
    uint label;     // group * 2^26 + molecule
    vec3 velocity;  // m/s, before the response
    float weight;   // 1/kg, 0 where held
    float radius;   // m
    bool fresh;     // its molecule has been born since the last step
    bool rests;     // its molecule does: nothing moves it
};

Sphere sphereAt(int slot)
{
    uvec4 place = placesAt(slot);
    uvec4 motion = motionAt(slot);
    bool stays = RESTS && rested(slot) && rowOf(slot) == NO_ROW;
    return Sphere(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(motion.xyz), stays ? 0.0 : withoutFlag(motion.w),
                  radiusAt(slot), hasFlag(motion.w), stays);
}

vec2 materialOf(Sphere a, Sphere b)
{
    return materialsAt(int(a.label >> 26u) * groupCount + int(b.label >> 26u)).xy;
}

int listedOf(int slot)
{
    return listedIn(countsAt(slot));
}

// Whether the list of a slot holds another: one that is full may not, and then neither takes the contact.
bool holds(int slot, int other)
{
    int listed = int(countsAt(slot) & CONTACTS);
    bool found = listed <= LIST;
    int e = found ? LIST : 0;
    while (e < LIST) {
        found = found || int(listsAt(slot, e)) == other;
        ++e;
    }
    return found;
}

BodySphere bodyOf(int slot, Sphere sphere)
{
    if (!BODIES || sphere.rests) return noBody;
    return bodySphereAt(sphereOf(slot));
}

struct Pair {
    Sphere sphere;  // the other
    vec3 apart;     // m, from its centre to this one's
    PairContact contact;
    bool meets;     // they take part in the response together
    vec2 material;  // x restitution, y friction
    BodySphere body;
};

Sphere own;
BodySphere ownBody;

void loadSphere(int slot)
{
    own = sphereAt(slot);
    ownBody = bodyOf(slot, own);
}

// Returns what an impulse of 1 N s on a sphere changes of its velocity, 1/kg: x along the unit vector n, y across it, or more.
vec2 weightsOf(Sphere sphere, BodySphere body, vec3 n)
{
    if (!BODIES) return vec2(sphere.weight);
    vec3 across = cross(body.arm, n);
    float turning = dot(across, body.perInertia * across);
    return sphere.weight + vec2(turning, max(body.turning - turning, 0.0));
}

#pragma reads effectiveCounts

// The effective number of contacts (physics/pair.glsl) by which a sphere's Jacobi step is divided: 1 for a resting sphere, whose 1/mass is
// 0; 0 where neither it nor its body touches another.
float effectiveCountOf(int slot, Sphere sphere)
{
    return sphere.rests ? 1.0 : uintBitsToFloat(effectiveCountsAt(slot));
}

// Returns what it changes of the two spheres' relative velocity. `effective`: the effective counts of the two.
vec2 weightsBetween(Pair pair, vec3 n, vec2 effective)
{
    return weightsOf(own, ownBody, n) * effective.x + weightsOf(pair.sphere, pair.body, n) * effective.y;
}

// Returns d, the way from the centre of another slot's sphere to that of a slot's, m, or where the two coincide a very short one.
vec3 parted(vec3 d, float reach, int slot, int other)
{
    bool coincide = dot(d, d) <= 1e-12 * reach * reach;
    while (coincide) {  // rare (contact/search/find.pass.glsl)
        uvec2 numbers = uvec2(placesAt(other).w, placesAt(slot).w);  // molecules leave as a whole
        if (numbers.x == numbers.y) numbers = uvec2(sphereOf(other), sphereOf(slot));
        d = directionFrom(numbers.x, numbers.y) * (1e-6 * reach);
        coincide = false;
    }
    return d;
}

Pair pairOf(int slot, int other)
{
    Pair pair;
    pair.sphere = sphereAt(other);
    pair.apart = localDifference(own.place, pair.sphere.place, cell);
    float reach = own.radius + pair.sphere.radius;
    pair.contact = pairContact(parted(pair.apart, reach, slot, other), own.velocity - pair.sphere.velocity, reach);
    pair.material = materialOf(own, pair.sphere);
    pair.body = bodyOf(other, pair.sphere);
    return pair;
}

// Returns how large an impulse may be that the next step begins with, N s, of one that began with `start` and has this `size`. What has
// stopped a fall is not what holds up what lies there, so memory takes in a tenth of what it has grown by, and where it carried
// little not much more than a weight. With half of it, molecules deep in a pile are shaken by what is remembered of their many
// contacts without balance. `weight`: 1/kg, of all that it moves.
float mostRemembered(float start, float size, float weight)
{
    return min(start + 0.1 * max(size - start, 0.0), 1.5 * start + restSpeed / weight);
}

// Returns a contact's impulse as the next step begins with it.
ContactImpulse remembered(ContactImpulse known, Sphere other)
{
    float size = length(known.impulse);
    float most = known.kind == PERSISTENT ? mostRemembered(known.start, size, own.weight + other.weight) : 0.0;
    known.impulse *= min(1.0, most / max(size, 1e-30));
    if (known.kind == PERSISTENT) known.start = length(known.impulse);
    return known;
}

// Whether the own sphere is to bounce off a collider in its next step, which answers that.
bool bouncesNext(NearCollider near)
{
    return !SPREADS && near.bounces && near.gap > 0.0 && dot(near.velocity - own.velocity, near.normal) > restSpeed;
}

bool isDeep(PairContact contact, float reach)
{
    return contact.depth > 0.25 * reach;
}

// Where spheres have sunk deep into one another, the way out is that by which they came in.
void leaveAsCome(inout Pair pair, vec3 anchor)
{
    float reach = own.radius + pair.sphere.radius;
    if (!isDeep(pair.contact, reach)) return;
    vec3 n = anchor / max(length(anchor), 1e-30);
    pair.contact.normal = n;
    pair.contact.depth = reach - dot(pair.apart, n);
    pair.contact.speed = dot(own.velocity - pair.sphere.velocity, n);
}

// The pair of a contact that prepare() has begun.
Pair pairAs(int slot, int other, ContactImpulse begun)
{
    Pair pair = pairOf(slot, other);
    pair.meets = begun.kind != NO_PART;
    leaveAsCome(pair, begun.anchor);
    return pair;
}
