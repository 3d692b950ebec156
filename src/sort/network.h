// The passes of two sorting networks. In a pass every element meets at most one other, and the smaller of the
// two keys goes to the smaller place: no pass undoes what another did, and elements past the last behave as
// if they had the greatest key and stay, so that any number can be sorted.
//
// Because all comparators point the same way, no pass adds an inversion: exchanging two elements that stand
// the wrong way round removes that inversion, and adds none with what stands between them.
#pragma once

#include <cstddef>
#include <vector>

namespace shoal {

// Odd-even merge sort: [Batcher 1968]; [Latta 2004, section 3.4.4]. Elements e and e + distance are compared
// where both lie in the same block of 2 * run and e - (distance mod run) has not the bit `distance`. t (t +
// 1) / 2 passes for up to 2^t elements.
struct OddEvenPass {
    int run;  // sorted runs of this length are merged in pairs
    int distance;
};
std::vector<OddEvenPass> oddEvenMergePasses(size_t count);

// Bitonic sort: [Batcher 1968]; UberFlow [Kipfer 2004, section 4.3.3],
// with two elements a texel: texel t holds the elements 2 t and 2 t + 1. The texels t and t ^ mask are
// compared, their elements crosswise in the first pass of a merge (which reads the other run backwards, where
// UberFlow reverses rows) and straight in the others. Merging the two elements of a texel takes no pass of
// its own. t (t - 1) / 2 passes for up to 2^t elements, t > 1.
struct BitonicPass {
    int mask;  // 0: only within the texel
    bool crossed;
    bool first;  // the two elements of each texel are sorted before
    bool last;   // and after
};
// Sorts every block of `block` elements, a power of two, by itself: those of a row, or all at once.
std::vector<BitonicPass> bitonicPasses(size_t block);

size_t powerOfTwoAbove(size_t count);  // the least that is not below

}  // namespace shoal
