// Keys and numbers of what is sorted, as the bitonic sort has them (src/sort/network_sort.h): two pairs a texel, in rows of the
// same 2^ROW_BITS texels as everything else. `count`: of all.
#include "state/numbered.glsl"

uvec2 pairAt(usampler2D pairs, int i)
{
    uvec4 two = fetch(pairs, i >> 1);
    return (i & 1) == 0 ? two.xy : two.zw;
}

// The first place whose key is not below this one; `count` if all are.
int placeOfKey(usampler2D pairs, uint key, int count)
{
    int low = 0;
    int high = count;
    while (low < high) {
        int middle = (low + high) >> 1;
        if (pairAt(pairs, middle).x < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

// Returns the place of the pair of a number, searched for from the first place of its key on: the sort is not
// stable, but keeps every pair.
int placeOfNumber(usampler2D pairs, uint number, int from, int count)
{
    int place = from;
    while (place < count - 1 && pairAt(pairs, place).y != number) ++place;
    return place;
}
