// Spheres in the order of their keys and, in a cell, of their numbers, because the sort was stable: places and cells by slot, the slot of each
// sphere, and where each cell begins.
#include "contact/grid/begin_slot.glsl"
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
