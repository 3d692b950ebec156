// The sorts of src/sort against each other, UberFlow's figures, std::sort and a copy of the same bytes:
// UberFlow's table of sorts [Kipfer 2004, table 1], a square of pairs
// at a time.
//
// All cases of a size take turns, round after round, like those of bench/bench.h. A sample: the unsorted
// pairs back (not timed), one sort between two waits. Keys are random, all 32 bits of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "measure/timing.h"
#include "sort/sorter.h"

namespace shoal::bench {

struct SortTime {
    std::string name = {};
    std::optional<SortMethod> method = {};  // none: std::sort, or the copy
    bool rowsOnly = false;
    bool copy = false;             // of the pairs, once, by the device
    int passes = 0;                // over the pairs; 0: not of passes
    std::string leftOut = {};      // why it was not measured; empty: it was
    measure::Spread seconds = {};  // of one sort, wall time
    measure::Spread device = {};   // s, the device's own time of one
};

struct SortTable {
    static constexpr int mostOfAll = 1024;  // the largest side for every sort, beyond it for radix
    int side = 0;                           // side * side pairs, in rows of `side`
    std::vector<SortTime> times;

    size_t pairs() const { return size_t(side) * size_t(side); }
    const SortTime* find(SortMethod method, bool rowsOnly = false) const;
    const SortTime& stdSort() const { return times.at(times.size() - 2); }
    const SortTime& copy() const { return times.at(times.size() - 1); }
    double itemsPerSecond(const SortTime& time) const {  // by the shortest
        return time.seconds.min > 0 ? double(pairs()) / time.seconds.min : 0;
    }
    // A pass of the radix sort against a copy, which moves as many bytes as a pass does at the least.
    std::optional<double> shareOfCopy(const SortTime& time) const;
};

// Keys of all bits of the mask, with their indices; the same every time.
std::vector<KeyIndex> randomKeys(size_t count, uint32_t mask = ~0u);

// A sort that the device has no memory for is left out. Error: a sort did not sort; the driver refuses a
// shader.
SortTable measureSorts(int side, const BenchDevice& device, const measure::Schedule& schedule);
// The speed of a sort as others published it.
struct PublishedSort {
    const char* where;
    std::array<double, 4> millionItems;  // a second, for 128, 256, 512 and 1024 squared
};
std::vector<PublishedSort> publishedSorts();

}  // namespace shoal::bench
