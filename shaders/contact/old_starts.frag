// starts: a texel a key: the first slot whose key is not below it.
#include "state/numbered.glsl"
#include "sort/pairs.glsl"

uniform usampler2D sorted;
uniform int count;

layout(location = 0) out uvec4 start;

void main()
{
    start = uvec4(uint(placeOfKey(sorted, uint(ownNumber()), count)), 0u, 0u, 0u);
}
