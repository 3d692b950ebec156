// The keys that fragments sort, two spheres a texel.
#include "state/lanes.glsl"
#include "physics/cells.glsl"
#pragma reads sphereCells spherePlaces
#pragma writes keys

uniform int keyMask;
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
