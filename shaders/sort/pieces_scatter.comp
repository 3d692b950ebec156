// Radix sort by pieces: moves the pairs of each lane's piece to their places, in their order.
#include "sort/digit.glsl"

layout(local_size_x = LANES) in;

uniform usamplerBuffer pairs;
uniform int count, parts, piece;

layout(std430) readonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer Totals { uint totals[]; };
// A pair as one double, because a CPU rasteriser makes its stores one by one.
layout(std430) writeonly buffer Sorted { double sorted[]; };

uint place[MOST_DIGITS];

void main()
{
    int lane = int(gl_GlobalInvocationID.x);
    int first = lane * piece, end = min(first + piece, count);
    uint before = 0u;  // pairs of smaller digits
    for (int d = 0; d < digits; ++d) {
        place[d] = before + counts[d * parts + lane];
        before += totals[d];
    }
    for (int i = first; i < end; ++i) {
        uvec2 pair = texelFetch(pairs, i).xy;
        uint d = digitOf(pair.x);
        sorted[place[d]] = packDouble2x32(pair);
        ++place[d];
    }
}
