// Finds places by their rank among those whose bit is set, down the tree of births/sums.frag: the free ones or, with
// DEATHS, those in which one died. Set by C++: LEVELS of the tree, 1 to 4.
uniform usampler2D bits;
uniform usampler2D sums1;
#if LEVELS > 1
uniform usampler2D sums2;
#endif
#if LEVELS > 2
uniform usampler2D sums3;
#endif
#if LEVELS > 3
uniform usampler2D sums4;
#define TOP sums4
#elif LEVELS > 2
#define TOP sums3
#elif LEVELS > 1
#define TOP sums2
#else
#define TOP sums1
#endif
#ifdef DEATHS
#define ranked(both) (both).y
#else
#define ranked(both) (both).x
#endif

// How many are set in all.
uint bitsInAll()
{
    uvec4 last = texelFetch(TOP, ivec2(31, 0), 0);
    return ranked(last.xy) + ranked(last.zw);
}

// Returns the child that holds a rank below its parent's count; `rank` becomes the rank within that child.
int childOf(usampler2D sums, int parent, inout uint rank)
{
    int child = 0;
    for (int more = 16; more > 0; more >>= 1) {
        if (ranked(texelFetch(sums, ivec2(child + more, parent), 0).xy) <= rank) child += more;
    }
    rank -= ranked(texelFetch(sums, ivec2(child, parent), 0).xy);
    return parent * 32 + child;
}

// The place of a rank below bitsInAll().
int placeOfRank(uint rank)
{
    int item = 0;
#if LEVELS > 3
    item = childOf(sums4, item, rank);
#endif
#if LEVELS > 2
    item = childOf(sums3, item, rank);
#endif
#if LEVELS > 1
    item = childOf(sums2, item, rank);
#endif
    item = childOf(sums1, item, rank);
    uint word = ranked(texelFetch(bits, ivec2(item % 32, item / 32), 0).xy);
    int bit = 0;
    for (; bit < 31; ++bit) {
        if (((word >> uint(bit)) & 1u) == 1u) {
            if (rank == 0u) break;
            --rank;
        }
    }
    return item * 32 + bit;
}
