// Inputs to test sorts on: pairs of a key and an index, keys in every kind of order, indices that count up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sort/sorter.h"

namespace sorting {

using Pair = shoal::KeyIndex;
using Pairs = std::vector<Pair>;

struct Input {
    std::string name;
    Pairs pairs;
};
// Random, sorted, reversed, all equal, few distinct, organ pipe, alternating, zeros and ones (which are
// enough to find a fault in a sorting network: Knuth, The Art of Computer Programming 3, 5.3.4, theorem Z),
// greatest.
std::vector<Input> inputs(size_t count, uint32_t seed);
Pairs randomPairs(size_t count, uint32_t seed);

// By the low bits of the keys, equal ones in the order that they had: what a stable sort must give.
Pairs sorted(Pairs pairs, int keyBits = 32);

}  // namespace sorting
