// Radix sort by pieces: counts the digits of each lane's piece. counts[digit * parts + lane].
#include "sort/digit.glsl"

layout(local_size_x = LANES) in;

uniform usamplerBuffer pairs;  // x key, y index
uniform int count, parts;      // pairs; lanes with a piece
uniform int piece;             // pairs of one

layout(std430) writeonly buffer Counts { uint counts[]; };

uint own[MOST_DIGITS];

void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    int first = lane * piece, end = min(first + piece, count);
    for (int d = 0; d < digits; ++d) own[d] = 0u;
    for (int i = first; i < end; ++i) ++own[digitOf(texelFetch(pairs, i).x)];
    for (int d = 0; d < digits; ++d) counts[d * parts + lane] = own[d];
}
