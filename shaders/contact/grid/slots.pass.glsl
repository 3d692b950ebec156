// The place of each sphere in the order of the keys, in fragments.
#include "state/lanes.glsl"
#include "sort/pairs.glsl"
#include "physics/cells.glsl"
#pragma reads sorted sphereCells starts
#pragma writes slots

uniform int keyMask;

void main()
{
    int sphere = ownLane();
    uint key = cellKey(ivec3(sphereCellsAt(sphere).xyz), uint(keyMask));
    putSlots(sphere, uint(placeOfNumber(sorted, uint(sphere), int(startsAt(int(key))), numbers)));
}
