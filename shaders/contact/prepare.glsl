// The first stage of contact/respond.glsl.
#include "contact/respond.glsl"

// The last step has left these:
uniform UINTS oldSlots;      // of a sphere
uniform UINTS oldCounts;     // by slot, as `counts`
uniform LISTS oldLists;
uniform ENTRIES oldPushes;   // as it left them (Entry)
uniform ENTRIES oldAnchors;
uniform FLOATS oldKnown;     // N s, by slot: the sum of what its contacts remember, which has acted as a force since

int oldSlot;
int oldListed;  // 0 where nothing is remembered

void loadOld(int slot)
{
    loadSphere(slot);
    oldSlot = int(fetch(oldSlots, sphereOf(slot)).x);
    oldListed = own.fresh ? 0 : min(int(fetch(oldCounts, oldSlot).x & CONTACTS), LIST);
}

vec3 actedOn()
{
    return oldListed > 0 ? fetch(oldKnown, oldSlot).xyz : vec3(0.0);
}

Entry prepare(int slot, int other)
{
    int otherOld = int(fetch(oldSlots, sphereOf(other)).x);
    int at = -1;
    for (int e = 0; e < oldListed; ++e) at = entryIn(oldLists, oldSlot, e) == otherOld ? e : at;
    Entry old = Entry(entry(oldPushes, oldSlot, max(at, 0)), entry(oldAnchors, oldSlot, max(at, 0)));
    bool isOld = at >= 0 && old.anchor.w >= 0.0 && (fetch(motions, motionOf(other)).w & FRESH) == 0u;
    // what is remembered is no impact, however fast it closes
    Meeting with = meetingOf(slot, other, isOld ? 1e30 : restSpeed);
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
        return known;
    }
    if (isOld) {
        known.push.xyz = remembered(old);
        bool sticks = old.anchor.w > 0.0 && old.push.w >= 0.0;
        if (sticks || isDeep(contact, reach)) known.anchor.xyz = old.anchor.xyz;
    }
    leaveAsCome(with, known.anchor.xyz);
    known.push.xyz = withinFriction(known.push.xyz, with.contact.normal, with.material.y);
    known.anchor.w = length(known.push.xyz) + 1e-20;
    return known;
}

// Counts the contacts of a sphere, as they act on it together (physics/pair.glsl).
NormalSum normals = NormalSum(vec3(0.0), vec3(0.0));
float turning = 0.0;  // of its body, in contacts

void countIn(vec3 normal)
{
    float part = turningPart(normal);
    normals = withNormal(normals, normal * sqrt(1.0 - part));
    turning += part;
}

#ifdef WALLS
#include "contact/near_walls.glsl"

uniform WALL_RECORDS oldWalls;  // by sphere, of the last step

// Returns what the contact with a collider remembers, N s: that of the one in the last step whose normal was nearly the same.
// `old`: what those had, N s. Of a sphere that touches no other, its own step answers the collider.
vec3 prepareWall(int slot, Wall wall, int listed, vec3 old[MOST_WALLS])
{
    vec3 push = vec3(0.0);
    if (!pressesOn(wall) || listed == 0) return push;
    countIn(wall.normal);
    for (int o = 0; o < MOST_WALLS; ++o) {
        bool same = oldListed > 0 && dot(wallTexel(oldWalls, sphereOf(slot), 2 * o).xyz, wall.normal) > 0.9;
        push = same ? withinFriction(old[o], wall.normal, wall.friction) : push;
    }
    return push;
}
#endif
