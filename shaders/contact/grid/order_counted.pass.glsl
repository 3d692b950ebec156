// Spheres in the order of their keys and, in a cell, of their numbers: places and cells by slot, and the slot of each sphere. A sphere of
// `members` finds its slot by its number, so that a repeat gives the same slots.
#include "contact/grid/begin_slot.glsl"
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
