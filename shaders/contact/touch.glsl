// The list of a slot's contacts (contact/lists.glsl), while it is made. Needs contact/records.glsl.
#ifdef TEXTURES
uvec4 entries[LIST / 4];
#else
layout(std430) buffer Lists { uint lists[]; };
layout(std430) buffer Counts { uint counts[]; };
layout(std430) buffer Dropped { uint dropped; };  // contacts that no list had room for, so far
#include "contact/touching_groups.glsl"

uniform int listStride;
uniform bool last;  // no other search adds to what this one lists
#endif
#if defined(REMEMBERS) && defined(TEXTURES)
uniform UINTS oldSlots;   // contact/memory.glsl
uniform UINTS oldCounts;
#elif defined(REMEMBERS)
uniform samplerBuffer known;   // contact/memory.glsl
#endif
#ifdef RESTING
#include "contact/marks.glsl"
#endif
#ifdef SELF
uniform UINTS apart;    // ContactGroup::apart
uniform UINTS groupsOf;  // x first sphere, y spheres of a molecule, z first word, w words of a sphere; 0: none
#endif

int ownSlot;
vec3 ownPlace;
uint ownLabel;
ivec3 ownCell;
float ownRadius;
int found = 0;

void loadOwn(int slot)
{
    uvec4 place = fetch(places, slot);
    ownSlot = slot;
    ownPlace = uintBitsToFloat(place.xyz);
    ownLabel = place.w;
    uvec4 own = fetch(cells, slot);
    ownCell = ivec3(own.xyz);
    ownRadius = uintBitsToFloat(own.w & ~RESTS);
}

ivec3 cellOf(int slot)
{
    return ivec3(fetch(cells, slot).xyz);
}

// Whether spheres of this label are to be looked at.
bool mayMeet(uint label, int slot)
{
#ifdef SELF
    return slot != ownSlot;
#else
    return label != ownLabel;
#endif
}

#ifdef SELF
// Whether two spheres of one molecule may touch.
bool mayMeetSelf(int slot)
{
    ivec4 group = ivec4(fetch(groupsOf, int(ownLabel >> 26u)));
    if (group.w == 0) return false;
    int own = (sphereOf(ownSlot) - group.x) % group.y;
    int other = (sphereOf(slot) - group.x) % group.y;
    uint word = fetch(apart, group.z + own * group.w + other / 32).x;
    return (word >> uint(other & 31) & 1u) == 0u;
}
#endif

// Returns whether a neighbour in the order of the keys is to be tested for contact. Local places repeat, so
// they are compared only between cells next to each other.
bool isCandidate(int slot)
{
    ivec3 apart = abs(cellOf(slot) - ownCell);
    return mayMeet(fetch(places, slot).w, slot) && max(apart.x, max(apart.y, apart.z)) <= 1;
}

void take(int slot)
{
#ifdef TEXTURES
    entries[found >> 2][found & 3] = uint(slot);
#else
    lists[found * listStride + ownSlot] = uint(slot);
#endif
}

#if defined(SWEPT) || defined(RESTING)
#include "physics/pair.glsl"

uniform float stepTime;   // s, of a contact step
uniform float restSpeed;  // m/s

vec3 velocityOf(int slot)
{
    return uintBitsToFloat(fetch(motions, motionOf(slot)).xyz);
}

// Whether two spheres d apart have met within the last contact step, or passed through each other.
bool haveMet(vec3 d, float reach, int slot)
{
    return pairContact(d, velocityOf(ownSlot) - velocityOf(slot), reach, stepTime, restSpeed, 1.0).impact;
}
#endif

#ifdef RESTING
// An awake sphere marks the resting ones that it touches.
void markResting(int slot, vec3 d, float reach)
{
    if (rested(ownSlot) || !rested(slot)) return;
    bool struck = haveMet(d, reach, slot);
    mark(slot, struck ? TOUCHED | STRUCK : TOUCHED);
    if (struck) struckX = uint(count + 63) / 64u;
}
#endif

// Takes the sphere into the list if it touches.
void meet(int slot)
{
    vec3 d = localDifference(ownPlace, uintBitsToFloat(fetch(places, slot).xyz), cell);
    float sum = ownRadius + uintBitsToFloat(fetch(cells, slot).w & ~RESTS);
    float limit = sum * NEAR;  // a contact that opens by a hair stays one
    bool touches = dot(d, d) < limit * limit;
#ifdef SWEPT
    touches = touches || haveMet(d, sum, slot);
#endif
#ifdef SELF
    if (touches && fetch(places, slot).w == ownLabel) touches = mayMeetSelf(slot);
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
#include "contact/body_sums.glsl"
#endif
#include "contact/walls.glsl"

uniform WALL_RECORDS walls;  // by sphere

// Whether a collider holds a sphere that its step has not held: of a rigid body one that is near, of a triangle one that it overlaps.
bool isHeldByWall(int sphere)
{
    float gap = wallTexel(walls, sphere, 0).w;
#ifdef BODIES
    if (bodySphereAt(sphere).perMass > 0.0) return gap < 1e20;
#endif
    return gap < -restingOverlap * ownRadius;
}
#endif

// Returns the slot's count.
uint countFound(int slot)
{
    uint counted = uint(found);
#if defined(SPREAD) && defined(WALLS)
    if (isHeldByWall(sphereOf(slot))) counted |= HELD;
#endif
    bool responds = counted != 0u;
#if defined(REMEMBERS) && defined(TEXTURES)
    responds = responds || isActedOn(fetch(oldCounts, int(fetch(oldSlots, sphereOf(slot)).x)).x);
#elif defined(REMEMBERS)
    responds = responds || texelFetch(known, sphereOf(slot)).w > 0.0;
#endif
    return counted | (responds ? RESPONDS : 0u);
}

#ifndef TEXTURES
void finish(int slot)
{
    uint counted = countFound(slot);
    counts[slot] = counted;
    bool takes = last && counted > 0u;
    while (takes) {
        addTouching(slot);
        if (found > LIST) atomicAdd(dropped, uint(found - LIST));
        takes = false;
    }
}
#endif
