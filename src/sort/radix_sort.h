// Sorts pairs of a key and an index on the GPU by radix sort (OpenGL 4.3): least significant digit first, so
// that it is stable and takes as many passes as the keys have digits. A pass counts the digits of each part
// of the input, adds the counts up in the order of the result, and moves every pair to its place.
//
// No slot is given out by an atomic: a pair's place follows from the pairs before it alone, so a repeat gives
// the same bits. Two ways to the same result:
//   pieces: a lane takes a piece of its own, one pair after the other, and counts in a private array, in
//           digits of up to 11 bits. For CPU rasterisers: nothing is shared and nobody waits.
//   tiles:  a workgroup sorts a tile of 2,048 pairs by the digit in shared memory, then writes its runs, in
//           digits of up to 8 bits. For GPUs: neighbouring lanes write neighbouring memory.
// Sources: [Zagha 1991] (pieces), [Satish 2009] (tiles).
#pragma once

#include <cstddef>
#include <string>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/program.h"

namespace shoal {

class RadixSort {
  public:
    enum class Way { automatic, pieces, tiles };  // automatic: pieces where the context is a CPU rasteriser

    // For up to `capacity` pairs; takes as much memory again as they do, and some. Error: a context
    // below 4.3; more pairs than it can hold, with how many it can; out of memory.
    RadixSort(gpu::Context& context, size_t capacity, Way way = Way::automatic);
    // How many pairs a context can hold, by its limits; 0 below 4.3.
    static size_t most(const gpu::ContextInfo& info);

    // `pairs`: a storage buffer of uvec2, x the key, y the index. Its first `count` (up to the capacity; 0
    // does nothing) are sorted by the low `keyBits` (0 to 32) bits of the key, ascending, equal ones in the
    // order that they had. The result lies in `pairs` again, for texel fetches and storage blocks of whatever
    // follows. What earlier shaders wrote into it is seen. Higher bits of a key are kept, and count for
    // nothing. Changes the program in use.
    void sort(gpu::Buffer& pairs, size_t count, int keyBits);

    size_t capacity() const { return capacity_; }
    int passes(size_t count, int keyBits) const;  // over the data; 0: there is nothing to do
    size_t bytes() const { return other_.bytes() + counts_.bytes() + totals_.bytes(); }  // its own

  private:
    struct Pass {
        int count;   // of pairs
        int parts;   // lanes with a piece, or tiles
        int digits;  // a power of two
        int shift;   // of the digit in the key
    };
    int parts(size_t count, int digits) const;
    int digitBitsMost(size_t count) const;
    void run(const gpu::Buffer& from, const gpu::Buffer& to, const Pass& pass);
    void setPass(const gpu::Program& program, const Pass& pass) const;

    gpu::Context* context_;
    size_t capacity_;
    bool tiles_;
    int mostLanes_;  // of pieces
    gpu::Program count_, scan_, scatter_;
    gpu::Buffer other_, counts_, totals_;
};

}  // namespace shoal
