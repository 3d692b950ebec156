// Sorts pairs of a key and an index by a sorting network in fragment passes (OpenGL 3.3): reads one texture,
// draws into the other, swaps. Not stable by itself; the same bits at every repeat.
//
// Pairs lie in rows of `rowLength`, a power of two; pair i is in row i / rowLength. A texel, unsigned
// integers:
//   oddEvenMerge   one pair:  x key, y index
//   bitonic        two pairs: xy the even one, zw the odd one
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace shoal {

// An item that is sorted, by its key.
struct KeyIndex {
    uint32_t key = 0, index = 0;
    bool operator==(const KeyIndex&) const = default;
};

// The passes of two sorting networks. In a pass every element meets at most one other, and the smaller of the
// two keys goes to the smaller place: no pass undoes what another did, and elements past the last behave as
// if they had the greatest key and stay, so that any number can be sorted.
//
// Because all comparators point the same way, no pass adds an inversion: exchanging two elements that stand
// the wrong way round removes that inversion, and adds none with what stands between them.

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

class NetworkSort {
  public:
    enum class Kind { oddEvenMerge, bitonic };
    // The order of pairs with equal keys: any, or by their indices, as of a stable sort of ascending ones.
    // bitonic only.
    enum class Ties { any, byIndex };

    // rowLength 0: one that makes the texture about as wide as high. Error: more pairs than fit into the
    // largest texture of the context, with how many do; out of memory.
    NetworkSort(gpu::Context& context, Kind kind, size_t capacity, int rowLength = 0, Ties ties = Ties::any);
    static size_t most(const gpu::ContextInfo& info, Kind kind);

    // Sets what is sorted from now on: the first `count` pairs (at most the capacity). Ends a spread sort.
    void setCount(size_t count);
    size_t count() const { return count_; }

    void sort();
    // Only within each row, which are as many sorts at once (UberFlow, section 5: what its collisions need).
    // bitonic only.
    void sortRows();

    // The whole sort in `frames` parts (1 or more) of as even a number of passes as can be; then from the
    // start again. No part makes the order worse: the number of inversions never rises, as long as nobody
    // writes new keys in between. oddEvenMerge only.
    void beginSpread(int frames);
    void advance();

    std::vector<KeyIndex> download() const;  // counted as state

    // Pairs are drawn or uploaded into here before they are sorted, and read from here after.
    const gpu::Texture& pairs() const { return sides_[side_]; }
    gpu::Texture& pairs() { return sides_[side_]; }
    // To draw new keys: bind target(), read pairs(), then flip(). The viewport covers the rows of `count`
    // pairs.
    const gpu::Framebuffer& target() const { return targets_[1 - side_]; }
    void drawInto(const gpu::Framebuffer& target) const;
    void flip() { side_ = 1 - side_; }

    Kind kind() const { return kind_; }
    size_t capacity() const { return capacity_; }
    int rowLength() const { return rowLength_; }
    int passes() const;  // of sort()

  private:
    void run(const OddEvenPass& pass);
    void run(const BitonicPass& pass);
    void begin() const;
    int rows() const { return int((count_ + size_t(rowLength_) - 1) / size_t(rowLength_)); }

    Kind kind_;
    size_t capacity_, count_;
    int rowLength_;
    gpu::Texture sides_[2];
    gpu::Framebuffer targets_[2];
    int side_ = 0;
    gpu::Program program_;
    std::vector<OddEvenPass> spread_;
    int frames_ = 1, frame_ = 0;
};

}  // namespace shoal
