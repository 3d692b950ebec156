// The first stage of contact/respond.glsl.
#include "contact/respond.glsl"
#include "contact/memory.glsl"

int memory;      // of the own sphere
bool remembers;
int oldListed;

void loadOld(int slot)
{
    loadSphere(slot);
    memory = memoryOf(sphereOf(slot));
    remembers = !own.fresh && remembersAt(memory);
    oldListed = remembers ? countAt(memory) : 0;
}

// Returns from what the iterations set out to push apart what the last step pushed by `before`, kg m: from most of it while it still
// overlaps, or the pressure of a pile would travel afresh in each step, one contact an iteration. From 0.9 of it a pile sways.
float carriedOver(float before, float depth)
{
    return depth > 0.0 ? 0.7 * abs(before) : 0.0;
}

// Returns a contact's entry as the step begins with it. `with`: the meeting of that entry, as meetingAs() has it.
Entry prepare(int slot, int other, out Meeting with)
{
    int otherMemory = memoryOf(sphereOf(other));
    int at = -1;
    for (int e = 0; e < oldListed; ++e) at = entryIn(oldLists, memory, e) == otherMemory ? e : at;
    Entry old = Entry(entry(oldPushes, memory, max(at, 0)), entry(oldAnchors, memory, max(at, 0)));
    bool isOld = at >= 0 && old.anchor.w >= 0.0 && (fetch(motions, motionOf(other)).w & FRESH) == 0u;
    // what is remembered is no impact, however fast it closes
    with = meetingOf(slot, other, isOld ? 1e30 : restSpeed);
    PairContact contact = with.contact;
    float reach = own.radius + with.sphere.radius;
    // a little along the normal as well, which is then known where centres coincide
    vec3 place = (contact.impact ? vec3(0.0) : with.apart) + contact.normal * ((contact.impact ? 1.0 : 1e-6) * reach);
    Entry known = Entry(vec4(0.0), vec4(place, 0.0));
    if (contact.impact) return known;
    // what has not touched yet and comes fast will be an impact
    bool comes = !isOld && contact.depth <= 0.0 && contact.speed < -restSpeed;
    if (comes || !with.meets) {
        known.anchor.w = -1.0;
        with.meets = false;
        return known;
    }
    if (isOld) {
        known.push.xyz = remembered(old, with.sphere).push.xyz;
        bool sticks = old.anchor.w > 0.0 && old.push.w >= 0.0;
        if (sticks || isDeep(contact, reach)) known.anchor.xyz = old.anchor.xyz;
    }
    leaveAsCome(with, known.anchor.xyz);
    if (isOld) known.push.w = carriedOver(old.push.w, with.contact.depth);
    known.push.xyz = withinFriction(known.push.xyz, with.contact.normal, with.material.y);
    known.anchor.w = length(known.push.xyz) + 1e-20;
    return known;
}

// Counts the contacts of a sphere, as they act on it together (physics/pair.glsl).
ContactSum contacts = ContactSum(vec3(0.0), vec3(0.0), 0.0);

void countIn(vec3 normal)
{
    contacts = withContact(contacts, normal, own.weight / max(ownWeights(normal), vec2(1e-30)));
}

#ifdef WALLS
#include "contact/near_walls.glsl"

struct OldWall {
    vec4 push;  // xyz impulse, N s; w how far it pushes the sphere off, kg m
    vec3 normal;
};

// Returns a collider's push as the step begins with it: that of the one in the last step whose normal was nearly the same.
// A sphere that touches nothing else has its collider answered by its own step.
vec4 prepareWall(int slot, Wall wall, OldWall old[MOST_WALLS])
{
    vec4 push = vec4(0.0);
    if (!pressesOn(wall) || !isActedOn(fetch(counts, slot).x)) return push;
    countIn(wall.normal);
    for (int o = 0; o < MOST_WALLS; ++o) {
        bool same = remembers && dot(old[o].normal, wall.normal) > 0.9;
        vec4 kept = vec4(withinFriction(old[o].push.xyz, wall.normal, wall.friction), carriedOver(old[o].push.w, -wall.gap));
        push = same ? kept : push;
    }
    return push;
}
#endif
