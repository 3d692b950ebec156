// Radix sort by tiles: adds up along each digit's row of counts, a workgroup a digit. Each count becomes the sum of
// those before it; the whole row's goes into totals.
#include "sort/group_scan.glsl"

layout(local_size_x = LANES) in;

uniform int digits, parts;

layout(std430) buffer Counts { uint counts[]; };
layout(std430) writeonly buffer Totals { uint totals[]; };

void main()
{
    int lane = int(gl_LocalInvocationID.x), row = int(gl_WorkGroupID.x) * parts;
    uint sum = 0u;
    for (int first = 0; first < parts; first += LANES) {
        bool inside = first + lane < parts;
        uint total;
        uint before = sumBefore(inside ? counts[row + first + lane] : 0u, total);
        if (inside) counts[row + first + lane] = sum + before;
        sum += total;
    }
    if (lane == 0) totals[gl_WorkGroupID.x] = sum;
}
