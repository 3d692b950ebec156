// A tree of sums over the places of a group: the free ones, or those in which a molecule died in this step. A node of level
// 0 is a word of bits for 32 places; a node of a higher level counts the set bits below it, in 32 nodes of the level below.
// Four nodes lie together. The highest level lies in `sums`, and each level in another array than the one above it
// (BirthPasses::sum).
#include "births/bits_in.glsl"
#pragma reads sums sumsBelow

uniform ivec4 tree[7];  // of each level: x where it begins, y how many fours of nodes there are
uniform int levels;     // the highest level, which has at most 32 nodes

uvec4 fourAt(int level, int four)
{
    int i = tree[level].x + four;
    return ((levels - level) & 1) == 0 ? sumsAt(i) : sumsBelowAt(i);
}

// Returns how many bits are set below each of four nodes.
ivec4 countsIn(int level, int four)
{
    uvec4 values = fourAt(level, four);
    return level == 0 ? bitsIn(values) : ivec4(values);
}

int countInAll()
{
    ivec4 sum = ivec4(0);
    for (int four = 0; four < 8; ++four) sum += countsIn(levels, four);
    return sum.x + sum.y + sum.z + sum.w;
}

// Returns the place whose bit is the one with this rank, from 0, among those that are set.
int placeOfRank(int rank)
{
    int node = 0;
    for (int level = levels; level >= 0; --level) {
        int four = 8 * node;
        ivec4 upTo;  // how many are set up to each of the four, with it
        for (int last = four + 7;; ++four) {
            ivec4 counts = countsIn(level, four);
            upTo = ivec4(counts.x, counts.x + counts.y, counts.x + counts.y + counts.z, 0);
            upTo.w = upTo.z + counts.w;
            if (four == last || rank < upTo.w) break;
            rank -= upTo.w;
        }
        int own = int(rank >= upTo.x) + int(rank >= upTo.y) + int(rank >= upTo.z);
        if (own > 0) rank -= upTo[own - 1];
        node = 4 * four + own;
    }
    uint word = fourAt(0, node / 4)[node % 4];
    for (; rank > 0; --rank) word &= word - 1u;
    return 32 * node + bitsIn(uvec4((word & (~word + 1u)) - 1u)).x;
}
