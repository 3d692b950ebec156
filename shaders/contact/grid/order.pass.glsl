// Spheres in the order of their keys and, in a cell, of their numbers: places and cells by slot; with buffers the slot of each sphere and,
// without COUNTED, where each cell begins. With COUNTED a sphere of `members` finds its slot by its number, so that a repeat gives the same
// slots; else the sort was stable.
#include "state/lanes.glsl"
#pragma reads spherePlaces sphereCells
#ifdef TEXTURES
#pragma reads sorted sphereMotions
#pragma writes places motions cells

void main()
{
    int slot = ownLane();
    int sphere = int(sortedAt(slot).y);
    putPlaces(slot, spherePlacesAt(sphere));
    putMotions(slot, sphereMotionsAt(sphere));
    putCells(slot, sphereCellsAt(sphere));
}
#else
#include "contact/search/respond.glsl"
#pragma writes slots
#ifdef RESTING
#pragma writes marks
#include "contact/rest/mark_groups.glsl"
#endif
#ifdef COUNTED
#pragma reads arrivals starts members
#pragma writes sorted places cells

#ifdef STAGGERED
uniform bool onlyKeys;  // of a second grid
#else
const bool onlyKeys = false;
#endif
#else
#include "sort/starts.glsl"

uniform int keys;

// A 4-vector as two doubles, because a CPU rasteriser makes its stores one by one.
layout(std430) writeonly buffer Places { dvec2 newPlaces[]; };
layout(std430) writeonly buffer Cells { dvec2 newCells[]; };

dvec2 asDoubles(uvec4 value)
{
    return dvec2(packDouble2x32(value.xy), packDouble2x32(value.zw));
}
#endif

void main()
{
    int slot = ownLane();
#ifdef COUNTED
    uint sphere = membersAt(slot);
    uint key = arrivalsAt(int(sphere)).x;
    int first = int(startsAt(int(key)));
    int end = int(startsAt(int(key) + 1));
    slot = first;
    for (int i = first; i < end; ++i) slot += int(membersAt(i) < sphere);
    putSorted(slot, uvec2(key, sphere));
    if (onlyKeys) return;
    uvec4 place = spherePlacesAt(int(sphere));
    uvec4 cell = sphereCellsAt(int(sphere));
    putPlaces(slot, place);
    putCells(slot, cell);
#else
    uvec2 pair = sortedAt(slot);
    uint sphere = pair.y;
    uvec4 place = spherePlacesAt(int(sphere));  // both before a store, which a compiler moves no load across
    uvec4 cell = sphereCellsAt(int(sphere));
    newPlaces[slot] = asDoubles(place);
    newCells[slot] = asDoubles(cell);
    writeStarts(slot, pair.x, numbers, keys);
#endif
    putSlots(sphere, uint(slot));
#ifdef RESTING
    putMarks(slot, 0u);
#endif
    if (gl_GlobalInvocationID.x == 0u) {
        noneResponds();
#ifdef RESTING
        noneMarked();
#endif
    }
}
#endif
