#include "gl/sort_inputs.h"

#include <algorithm>
#include <functional>
#include <random>

namespace sorting {

static Pairs pairsOf(size_t count, const std::function<uint32_t(size_t)>& key) {
    Pairs out(count);
    for (size_t i = 0; i < count; ++i)
        out[i] = {key(i), uint32_t(i)};
    return out;
}

Pairs randomPairs(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    return pairsOf(count, [&](size_t) { return uint32_t(random()); });
}

std::vector<Input> inputs(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    const auto n = uint32_t(count);
    std::vector<Input> out;
    const auto add = [&](const char* name, const std::function<uint32_t(uint32_t)>& key) {
        out.push_back({name, pairsOf(count, [&](size_t i) { return key(uint32_t(i)); })});
    };
    add("random", [&](uint32_t) { return uint32_t(random()); });
    add("sorted", [](uint32_t i) { return i; });
    add("reversed", [&](uint32_t i) { return n - i; });
    add("equal", [](uint32_t) { return 7u; });
    add("few distinct", [&](uint32_t) { return uint32_t(random() % 3) << 30; });
    add("organ pipe", [&](uint32_t i) { return std::min(i, n - i); });
    add("alternating", [&](uint32_t i) { return i % 2 == 0 ? i : n - i; });
    add("zeros and ones", [&](uint32_t) { return uint32_t(random()) & 1u; });
    add("greatest", [&](uint32_t) { return 0xffffffffu - (uint32_t(random()) & 1u); });
    return out;
}

Pairs sorted(Pairs pairs, int keyBits) {
    const uint32_t mask = keyBits >= 32 ? 0xffffffffu : (1u << keyBits) - 1;
    std::stable_sort(pairs.begin(), pairs.end(),
                     [&](const Pair& a, const Pair& b) { return (a.key & mask) < (b.key & mask); });
    return pairs;
}

}  // namespace sorting
