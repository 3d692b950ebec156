// slots: a texel a sphere: its place in the order of the keys.
#include "state/numbered.glsl"
#include "sort/pairs.glsl"
#include "physics/cells.glsl"

uniform usampler2D sorted;
uniform UINTS sphereCells;
uniform UINTS starts;
uniform int count;
uniform int keyMask;

layout(location = 0) out uvec4 slot;

void main()
{
    int sphere = ownNumber();
    if (sphere >= count) discard;
    uint key = cellKey(ivec3(fetch(sphereCells, sphere).xyz), uint(keyMask));
    slot = uvec4(uint(placeOfNumber(sorted, uint(sphere), int(fetch(starts, int(key)).x), count)), 0u, 0u, 0u);
}
