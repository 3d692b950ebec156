// keys: what is sorted, two spheres a texel.
#include "state/numbered.glsl"
#include "physics/cells.glsl"
#include "contact/staggered.glsl"

uniform UINTS sphereCells;
uniform UINTS spherePlaces;
uniform int count;
uniform int keyMask;
uniform float cell;
uniform bool staggered;  // of a second grid

layout(location = 0) out uvec4 pairs;

uvec2 pairOf(int sphere)
{
    int known = min(sphere, count - 1);  // the sort leaves those behind the last alone
    ivec3 own = ivec3(fetch(sphereCells, known).xyz);
    uint key = cellKey(own, uint(keyMask));
    if (staggered) key = staggeredKey(own, uintBitsToFloat(fetch(spherePlaces, known).xyz), cell, keyMask);
    return uvec2(key, uint(sphere));
}

void main()
{
    int first = 2 * ownNumber();
    pairs = uvec4(pairOf(first), pairOf(first + 1));
}
