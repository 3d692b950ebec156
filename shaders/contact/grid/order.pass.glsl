// Spheres in the order of their keys and, in a cell, of their numbers, in fragments: places, motions and cells by slot.
#include "state/lanes.glsl"
#pragma reads sorted spherePlaces sphereMotions sphereCells
#pragma writes places motions cells

void main()
{
    int slot = ownLane();
    int sphere = int(sortedAt(slot).y);
    putPlaces(slot, spherePlacesAt(sphere));
    putMotions(slot, sphereMotionsAt(sphere));
    putCells(slot, sphereCellsAt(sphere));
}
