// The keys that fragments sort, two spheres a texel; once they are sorted, with SLOTS, the place of each sphere in their order.
#include "state/lanes.glsl"
#include "physics/cells.glsl"

uniform int keyMask;

#ifdef SLOTS
#include "sort/pairs.glsl"
#pragma reads sorted sphereCells starts
#pragma writes slots

void main()
{
    int sphere = ownLane();
    uint key = cellKey(ivec3(sphereCellsAt(sphere).xyz), uint(keyMask));
    putSlots(sphere, uint(placeOfNumber(sorted, uint(sphere), int(startsAt(int(key))), numbers)));
}
#else
#pragma reads sphereCells spherePlaces
#pragma writes keys

uniform float cell;
uniform bool isStaggered;  // of a second grid

uvec2 pairOf(int sphere)
{
    int known = min(sphere, numbers - 1);  // the sort leaves those behind the last alone
    ivec3 own = ivec3(sphereCellsAt(known).xyz);
    uint key = cellKey(own, uint(keyMask));
    if (isStaggered) key = staggeredKey(own, uintBitsToFloat(spherePlacesAt(known).xyz), cell, keyMask);
    return uvec2(key, uint(sphere));
}

void main()
{
    int first = 2 * ownNumber();
    newKeys = uvec4(pairOf(first), pairOf(first + 1));
}
#endif
