// Spheres in the order of their keys and, in a cell, of their numbers: places and cells by slot, in fragments also motions, with buffers also
// the slot of each sphere. What was counted (CELL_TILE) comes as `members`, of which a sphere finds its slot by its number, so that a repeat
// gives the same slots; what was sorted, by a sort that was stable, comes in order.
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
#include "contact/flags.glsl"
#include "contact/response/batches.glsl"
#ifdef MARKS
#include "contact/rest/mark_groups.glsl"
#endif
#pragma writes slots marks responding

void noneResponds()
{
    putResponding(0, 0, 0u);
    for (int b = 0; b < batches.length(); ++b) batches[b] = Batch(0u, 1u, 1u, 0u);
}

// What every slot begins a step with.
void beginSlot(int slot, uint sphere)
{
    putSlots(sphere, uint(slot));
    putMarks(slot, 0u);
    if (RESTS) putResponding(1 + slot, 1, uint(NO_ROW));
    if (gl_GlobalInvocationID.x == 0u) {
        noneResponds();
#ifdef MARKS
        noneMarked();
#endif
    }
}

#ifdef CELL_TILE
#pragma reads arrivals starts members
#pragma writes sorted places cells

uniform bool onlyKeys;  // of a second grid

void main()
{
    uint sphere = membersAt(ownLane());
    uint key = arrivalsAt(int(sphere)).x;
    int first = int(startsAt(int(key)));
    int end = int(startsAt(int(key) + 1));
    int slot = first;
    for (int i = first; i < end; ++i) slot += int(membersAt(i) < sphere);
    putSorted(slot, uvec2(key, sphere));
    if (STAGGERS && onlyKeys) return;
    uvec4 place = spherePlacesAt(int(sphere));
    uvec4 cell = sphereCellsAt(int(sphere));
    putPlaces(slot, place);
    putCells(slot, cell);
    beginSlot(slot, sphere);
}
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

void main()
{
    int slot = ownLane();
    uvec2 pair = sortedAt(slot);
    uint sphere = pair.y;
    uvec4 place = spherePlacesAt(int(sphere));  // both before a store, which a compiler moves no load across
    uvec4 cell = sphereCellsAt(int(sphere));
    newPlaces[slot] = asDoubles(place);
    newCells[slot] = asDoubles(cell);
    writeStarts(slot, pair.x, numbers, keys);
    beginSlot(slot, sphere);
}
#endif
#endif
