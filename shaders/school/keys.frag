// A texel for two entries.
#include "school/keys.glsl"

uniform int count;

layout(location = 0) out uvec4 pairs;

void main()
{
    int first = 2 * ownNumber();  // the sort leaves those behind the last alone
    pairs = uvec4(pairOf(min(first, count - 1)), pairOf(min(first + 1, count - 1)));
}
