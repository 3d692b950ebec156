// A level of the tree (births/tree.glsl) above level 0: a node counts what is set in 32 nodes of the level below.
#include "state/lanes.glsl"
#include "births/bits_in.glsl"
#pragma reads sumsBelow
#pragma writes sums

uniform ivec4 below;  // the level below: x where it begins, y how many fours of nodes there are, z whether they are bits

void main()
{
    int four = ownLane();
    uvec4 sums = uvec4(0u);
    for (int node = 0; node < 4; ++node) {
        int first = 8 * (4 * four + node);
        ivec4 sum = ivec4(0);
        for (int child = first; child < min(first + 8, below.y); ++child) {
            uvec4 values = sumsBelowAt(below.x + child);
            sum += below.z != 0 ? bitsIn(values) : ivec4(values);
        }
        sums[node] = uint(sum.x + sum.y + sum.z + sum.w);
    }
    putSums(firstNumber + four, sums);
}
