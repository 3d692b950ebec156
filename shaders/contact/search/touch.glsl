// Which spheres a slot may touch, and those that it does.
#include "state/lanes.glsl"
#ifdef MARKS
#include "contact/rest/marks.glsl"
#include "contact/response/kept.glsl"
#endif
#include "contact/grid/colliders.glsl"
#include "contact/response/memory.glsl"
#include "contact/response/body.glsl"
#include "physics/pair.glsl"
#pragma reads apart groupsOf

int searching;  // the slot
vec3 ownPlace;
uint ownLabel;
ivec3 ownCell;
float ownRadius;
int found = 0;
uvec4 entries[LIST / 4];  // the list of its contacts, while it is made, in fragments, which write it at their end

void loadOwn(int slot)
{
    uvec4 place = placesAt(slot);
    searching = slot;
    ownPlace = uintBitsToFloat(place.xyz);
    ownLabel = place.w;
    uvec4 own = cellsAt(slot);
    ownCell = ivec3(own.xyz);
    ownRadius = withoutFlag(own.w);
    if (inTextures)
        for (int i = 0; i < LIST / 4; ++i) entries[i] = uvec4(0u);
}

ivec3 cellOf(int slot)
{
    return ivec3(cellsAt(slot).xyz);
}

// Whether spheres of this label are to be looked at.
bool mayMeet(uint label, int slot)
{
    return SELF ? slot != searching : label != ownLabel;
}

// Whether two spheres of one molecule may touch.
bool mayMeetSelf(int slot)
{
    ivec4 group = ivec4(groupsOfAt(2 * int(ownLabel >> 26u)));
    if (group.w == 0) return false;
    int own = (sphereOf(searching) - group.x) % group.y;
    int other = (sphereOf(slot) - group.x) % group.y;
    uint word = apartAt(group.z + own * group.w + other / 32);
    return (word >> uint(other & 31) & 1u) == 0u;
}

// Returns whether a neighbour in the order of the keys is to be tested for contact. Local places repeat, so
// they are compared only between cells next to each other.
bool isCandidate(int slot)
{
    ivec3 apart = abs(cellOf(slot) - ownCell);
    return mayMeet(placesAt(slot).w, slot) && max(apart.x, max(apart.y, apart.z)) <= 1;
}

// Whether two spheres d apart have met within the last contact step, or passed through each other.
bool haveMet(vec3 d, float reach, int slot)
{
    return nextImpact(d, velocityAt(searching) - velocityAt(slot), reach, stepTime, restSpeed).happens;
}

// Whether a collider holds a sphere that its step has not held: of a rigid body one that is near, of a triangle one that it overlaps.
bool isHeldByCollider(int sphere)
{
    if (!SPREADS || !COLLIDERS) return false;
    NearCollider nearest = colliderNear(sphere, 0);
    if (BODIES && bodySphereAt(sphere).perMass > 0.0) return isNear(nearest);
    return nearest.gap < -restingOverlap * ownRadius;
}

// Returns the slot's count.
uint countFound(int slot)
{
    int sphere = sphereOf(slot);
    uint counted = uint(found) | (isHeldByCollider(sphere) ? HELD : 0u);
    bool responds = counted != 0u || (RESTS && rested(slot)) || (REMEMBERS && remembersAt(memoryOf(sphere)));
    return counted | (responds ? RESPONDS : 0u);
}

#ifdef TEXTURES
#pragma writes counts dropped lists
#pragma reads oldDropped

void take(int slot)
{
    entries[found >> 2][found & 3] = uint(slot);
}

bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(entries[e >> 2][e & 3]) == slot;
    return known;
}

// Keeps what was found.
void finish(int slot)
{
    putCounts(slot, countFound(slot));
    putDropped(slot, oldDroppedAt(slot) + uint(max(found - LIST, 0)));
    newLists = entries;
}
#else
#include "contact/response/batches.glsl"
#pragma updates counts lists responding

layout(std430) buffer Dropped { uint dropped; };  // contacts that no list had room for, so far

uniform bool last;  // no other search adds to what this one lists

void take(int slot)
{
    putLists(searching, found, uint(slot));
}

bool isListed(int slot)
{
    bool known = false;
    for (int e = 0; e < min(found, LIST); ++e) known = known || int(listsAt(searching, e)) == slot;
    return known;
}

void addResponding(int slot)
{
    uint row = atomicAdd(respondingBuffer[0], 1u);
    atomicMax(batches[0].groupsX, row / 64u + 1u);
    putResponding(1u + row, 0, uint(slot));
    putResponding(1 + slot, 1, row);
}

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

// An awake sphere marks the resting ones that it touches. A contact that is closed has no impact, however the step pushes it.
void touchResting(int slot, vec3 d, float reach)
{
#ifdef MARKS
    if (rested(searching) || !rested(slot)) return;
    bool struck = haveMet(d, reach, slot);
    while (struck && isClosed(contactIn(memoryOf(sphereOf(searching)), memoryOf(sphereOf(slot))), false)) struck = false;  // rare
    mark(slot, struck ? TOUCHED | STRUCK : TOUCHED);
    if (struck) struckX = uint(count + 63) / 64u;
#endif
}

// Takes the sphere into the list if it touches.
void meet(int slot)
{
    vec3 d = localDifference(ownPlace, placeAt(slot), cell);
    float sum = ownRadius + radiusAt(slot);
    float limit = sum * NEAR;  // a contact that opens by a hair stays one
    bool touches = dot(d, d) < limit * limit;
    if (SWEEPS) touches = touches || haveMet(d, sum, slot);
    if (SELF && touches && placesAt(slot).w == ownLabel) touches = mayMeetSelf(slot);
    if (touches) {
        touchResting(slot, d, sum);
        if (found < LIST) take(slot);
        ++found;
    }
}
