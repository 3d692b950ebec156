// The list of a slot's contacts, while it is made.
#include "state/lanes.glsl"
#include "contact/slots.glsl"
#ifdef TEXTURES
#pragma writes counts dropped lists
#pragma reads oldDropped

uvec4 entries[LIST / 4];
#else
#include "contact/search/respond.glsl"

layout(std430) buffer Dropped { uint dropped; };  // contacts that no list had room for, so far

uniform bool last;  // no other search adds to what this one lists
#endif
#ifdef REMEMBERS
#include "contact/response/memory.glsl"
#endif
#ifdef SELF
#pragma reads apart groupsOf
#endif

int searching;  // the slot
vec3 ownPlace;
uint ownLabel;
ivec3 ownCell;
float ownRadius;
int found = 0;

void loadOwn(int slot)
{
    uvec4 place = placesAt(slot);
    searching = slot;
    ownPlace = uintBitsToFloat(place.xyz);
    ownLabel = place.w;
    uvec4 own = cellsAt(slot);
    ownCell = ivec3(own.xyz);
    ownRadius = withoutFlag(own.w);
}

ivec3 cellOf(int slot)
{
    return ivec3(cellsAt(slot).xyz);
}

// Whether spheres of this label are to be looked at.
bool mayMeet(uint label, int slot)
{
#ifdef SELF
    return slot != searching;
#else
    return label != ownLabel;
#endif
}

#ifdef SELF
// Whether two spheres of one molecule may touch.
bool mayMeetSelf(int slot)
{
    ivec4 group = ivec4(groupsOfAt(int(ownLabel >> 26u)));
    if (group.w == 0) return false;
    int own = (sphereOf(searching) - group.x) % group.y;
    int other = (sphereOf(slot) - group.x) % group.y;
    uint word = apartAt(group.z + own * group.w + other / 32);
    return (word >> uint(other & 31) & 1u) == 0u;
}
#endif

// Returns whether a neighbour in the order of the keys is to be tested for contact. Local places repeat, so
// they are compared only between cells next to each other.
bool isCandidate(int slot)
{
    ivec3 apart = abs(cellOf(slot) - ownCell);
    return mayMeet(placesAt(slot).w, slot) && max(apart.x, max(apart.y, apart.z)) <= 1;
}

void take(int slot)
{
#ifdef TEXTURES
    entries[found >> 2][found & 3] = uint(slot);
#else
    putLists(searching, found, uint(slot));
#endif
}

#if defined(SWEPT) || defined(RESTING)
#include "physics/pair.glsl"

uniform float stepTime;   // s, of a contact step
uniform float restSpeed;  // m/s

// Whether two spheres d apart have met within the last contact step, or passed through each other.
bool haveMet(vec3 d, float reach, int slot)
{
    return pairContact(d, velocityAt(searching) - velocityAt(slot), reach, stepTime, restSpeed, 1.0).impact;
}
#endif

#ifdef RESTING
// An awake sphere marks the resting ones that it touches.
void markResting(int slot, vec3 d, float reach)
{
    if (rested(searching) || !rested(slot)) return;
    bool struck = haveMet(d, reach, slot);
    mark(slot, struck ? TOUCHED | STRUCK : TOUCHED);
    if (struck) struckX = uint(count + 63) / 64u;
}
#endif

// Takes the sphere into the list if it touches.
void meet(int slot)
{
    vec3 d = localDifference(ownPlace, placeAt(slot), cell);
    float sum = ownRadius + radiusAt(slot);
    float limit = sum * NEAR;  // a contact that opens by a hair stays one
    bool touches = dot(d, d) < limit * limit;
#ifdef SWEPT
    touches = touches || haveMet(d, sum, slot);
#endif
#ifdef SELF
    if (touches && placesAt(slot).w == ownLabel) touches = mayMeetSelf(slot);
#endif
    if (touches) {
#ifdef RESTING
        markResting(slot, d, sum);
#endif
        if (found < LIST) take(slot);
        ++found;
    }
}

#if defined(SPREAD) && defined(WALLS)
#include "physics/pair.glsl"
#ifdef BODIES
#include "contact/response/body.glsl"
#endif
#pragma reads colliders

// Whether a collider holds a sphere that its step has not held: of a rigid body one that is near, of a triangle one that it overlaps.
bool isHeldByCollider(int sphere)
{
    float gap = collidersAt(sphere, 0).w;
#ifdef BODIES
    if (bodySphereAt(sphere).perMass > 0.0) return gap < 1e20;
#endif
    return gap < -restingOverlap * ownRadius;
}
#else
bool isHeldByCollider(int sphere)
{
    return false;
}
#endif

// Returns the slot's count.
uint countFound(int slot)
{
    int sphere = sphereOf(slot);
    uint counted = uint(found) | (isHeldByCollider(sphere) ? HELD : 0u);
    bool responds = counted != 0u;
#ifdef REMEMBERS
    responds = responds || remembersAt(memoryOf(sphere));
#endif
    return counted | (responds ? RESPONDS : 0u);
}

#ifdef TEXTURES
void finish(int slot)
{
    putCounts(slot, countFound(slot));
    putDropped(slot, oldDroppedAt(slot) + uint(max(found - LIST, 0)));
    newLists = entries;
}
#else
void finish(int slot)
{
    uint counted = countFound(slot);
    putCounts(slot, counted);
    bool takes = last && counted > 0u;
    while (takes) {
        addResponding(slot);
        if (found > LIST) atomicAdd(dropped, uint(found - LIST));
        takes = false;
    }
}
#endif
