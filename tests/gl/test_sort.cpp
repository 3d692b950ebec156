// The four sorts through their one interface, on every kind of input; what a sort promises beyond the order:
// what is stable, what a spread sort never makes worse, what does not fit.
#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/sort_inputs.h"
#include "sort/sorter.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace sorting;

namespace {

std::vector<SortMethodRow> methodsHere() {
    std::vector<SortMethodRow> out;
    for (const SortMethodRow& method : sortMethods())
        if (canRun(method.method, testContext().info())) out.push_back(method);
    return out;
}

Pairs sortedBy(Sorter& sorter, const Pairs& input) {
    sorter.upload(input);
    sorter.sort();
    return sorter.download();
}

// Ascending, and the pairs of the input.
void requireSorted(const Pairs& input, const Pairs& output, bool stable) {
    const Pairs expected = sorted(input);
    if (stable) {
        REQUIRE(output == expected);
        return;
    }
    const auto less = [](const Pair& a, const Pair& b) {
        return a.key != b.key ? a.key < b.key : a.index < b.index;
    };
    REQUIRE(std::is_sorted(output.begin(), output.end(),
                           [](const Pair& a, const Pair& b) { return a.key < b.key; }));
    Pairs ordered = output;
    std::sort(ordered.begin(), ordered.end(), less);
    REQUIRE(ordered == expected);  // whose indices count up
}

uint64_t inversions(const Pairs& pairs) {
    uint64_t out = 0;
    for (size_t i = 0; i < pairs.size(); ++i)
        for (size_t j = i + 1; j < pairs.size(); ++j)
            out += pairs[j].key < pairs[i].key;
    return out;
}

// How far the pairs, whose keys are all different, are from their places, in sum.
uint64_t displacement(const Pairs& pairs) {
    const Pairs end = sorted(pairs);
    uint64_t out = 0;
    for (size_t i = 0; i < pairs.size(); ++i) {
        const auto place = std::lower_bound(end.begin(), end.end(), pairs[i],
                                            [](const Pair& a, const Pair& b) { return a.key < b.key; });
        out += uint64_t(std::abs(int64_t(place - end.begin()) - int64_t(i)));
    }
    return out;
}

}  // namespace

TEST_CASE("every sort sorts every number of pairs around powers of two", "[sort]") {
    for (const SortMethodRow& method : methodsHere()) {
        Sorter sorter(testContext(), method.method, 128, method.network ? 16 : 0);
        for (size_t count = 0; count <= 128; ++count) {
            INFO(method.name << ", " << count << " pairs");
            const Pairs input = randomPairs(count, uint32_t(count));
            requireSorted(input, sortedBy(sorter, input), method.stable);
        }
    }
    testContext().checkErrors("sorts");
}

TEST_CASE("every sort sorts inputs of every kind, and again to the bit", "[sort]") {
    for (const SortMethodRow& method : methodsHere()) {
        for (const size_t count : {255, 256, 257, 1000}) {
            Sorter sorter(testContext(), method.method, count);
            for (const Input& input : inputs(count, 3)) {
                INFO(method.name << ", " << count << " pairs, " << input.name);
                const Pairs output = sortedBy(sorter, input.pairs);
                requireSorted(input.pairs, output, method.stable);
                REQUIRE(sortedBy(sorter, input.pairs) == output);
            }
        }
    }
}

TEST_CASE("the networks sort all zeros and ones, and so everything", "[sort]") {
    // Knuth 3, 5.3.4, theorem Z, for 11 pairs: a number of rows and a row that are not full.
    const size_t count = 11;
    for (const SortMethod method : {SortMethod::oddEvenMerge, SortMethod::bitonic}) {
        Sorter sorter(testContext(), method, count, 4);
        for (uint32_t bits = 0; bits < 1u << count; bits += method == SortMethod::bitonic ? 1 : 3) {
            Pairs input(count);
            for (uint32_t i = 0; i < count; ++i)
                input[i] = {bits >> i & 1u, i};
            INFO(row(method).name << ", " << bits);
            const Pairs output = sortedBy(sorter, input);
            REQUIRE(std::is_sorted(output.begin(), output.end(),
                                   [](const Pair& a, const Pair& b) { return a.key < b.key; }));
        }
    }
}

TEST_CASE("sorting rows only sorts each row by itself", "[sort]") {
    for (const int length : {2, 4, 16, 64}) {
        Sorter sorter(testContext(), SortMethod::bitonic, 200, length);
        for (const size_t count : {1, 2, 63, 64, 65, 199, 200}) {
            INFO(count << " pairs in rows of " << length);
            const Pairs input = randomPairs(count, 4);
            sorter.upload(input);
            sorter.sortRows();
            const Pairs output = sorter.download();
            for (size_t first = 0; first < count; first += size_t(length)) {
                const size_t end = std::min(count, first + size_t(length));
                const auto part = [&](const Pairs& all) {
                    return Pairs(all.begin() + long(first), all.begin() + long(end));
                };
                requireSorted(part(input), part(output), false);
            }
        }
    }
}

TEST_CASE("a spread sort ends sorted, and no part of it makes the order worse", "[sort]") {
    for (const size_t count : {2, 3, 100, 128, 300}) {
        Sorter sorter(testContext(), SortMethod::oddEvenMerge, count);
        for (const int frames : {1, 3, 20, 100}) {
            for (const Input& input : inputs(count, 8)) {
                INFO(count << " pairs, " << frames << " frames, " << input.name);
                const bool different = input.name == "random" || input.name == "reversed";
                sorter.upload(input.pairs);
                sorter.beginSpread(frames);
                Pairs now = input.pairs;
                for (int frame = 0; frame < frames; ++frame) {
                    sorter.advance();
                    const Pairs next = sorter.download();
                    REQUIRE(inversions(next) <= inversions(now));
                    if (different) REQUIRE(displacement(next) <= displacement(now));
                    now = next;
                }
                requireSorted(input.pairs, now, false);
            }
        }
    }
}

TEST_CASE("a spread sort takes as many passes a frame as its share, and starts again", "[sort]") {
    Sorter sorter(testContext(), SortMethod::oddEvenMerge, 64);
    const Pairs input = randomPairs(64, 9);
    sorter.upload(input);
    CHECK(sorter.passes() == 21);
    sorter.beginSpread(7);
    for (int frame = 0; frame < 6; ++frame)
        sorter.advance();
    CHECK_FALSE(sorter.download() == sorted(input));
    sorter.advance();
    CHECK(sorter.download() == sorted(input));
    for (int frame = 0; frame < 7; ++frame) {
        sorter.advance();
        CHECK(sorter.download() == sorted(input));  // a sorted order stays
    }
}

TEST_CASE("the networks take the passes that their papers count", "[sort]") {
    // Latta: log2(n) (log2(n) + 1) / 2; UberFlow's slides: 2 log2(n) fewer, two pairs a texel.
    CHECK(oddEvenMergePasses(1 << 20).size() == 210);
    CHECK(oddEvenMergePasses(128 * 128).size() == 105);
    CHECK(bitonicPasses(1 << 20).size() == 190);
    CHECK(bitonicPasses(1024).size() == 45);  // a row
}

TEST_CASE("where asked, a bitonic sort leaves equal keys in the order of their indices", "[sort]") {
    const size_t count = 777;
    NetworkSort sort(testContext(), NetworkSort::Kind::bitonic, count, 64, NetworkSort::Ties::byIndex);
    std::vector<KeyIndex> pairs((count + 63) / 64 * 64);
    for (uint32_t i = 0; i < count; ++i)
        pairs[i] = {i * 7919 % 13, i};
    sort.pairs().upload(gpu::Traffic::Kind::state, 0, 0, 32, int(pairs.size() / 64), pairs.data(),
                        pairs.size() * sizeof(KeyIndex));
    sort.sort();
    pairs.resize(count);
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const KeyIndex& a, const KeyIndex& b) { return a.key < b.key; });
    CHECK(sort.download() == pairs);
}

TEST_CASE("a sort larger than the context can hold says what fits", "[sort]") {
    for (const SortMethodRow& method : methodsHere()) {
        if (method.method == SortMethod::cpu) continue;
        const gpu::ContextInfo& info = testContext().info();
        const auto kind = method.method == SortMethod::bitonic ? NetworkSort::Kind::bitonic
                                                               : NetworkSort::Kind::oddEvenMerge;
        const size_t most = method.network ? NetworkSort::most(info, kind) : RadixSort::most(info);
        CHECK(most >= size_t(1) << 20);
        const std::string word = method.network ? concat(method.name, " sort") : "radix sort";
        CHECK(messageOf([&] { Sorter(testContext(), method.method, most + 1); }) ==
              concat(word, " of ", most + 1, " pairs is larger than this context can hold: ", most));
    }
    const int size = testContext().info().maxTextureSize;
    CHECK(messageOf([&] { Sorter(testContext(), SortMethod::oddEvenMerge, size_t(size) * 2 + 1, 2); }) ==
          concat("odd-even merge sort of ", size * 2 + 1,
                 " pairs in rows of 2 does not fit into a texture of this context, of at most ", size, " x ",
                 size, " texels"));
    testContext().checkErrors("refused sorts");
}
