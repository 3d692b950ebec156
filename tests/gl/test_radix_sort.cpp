// Radix sort on the GPU, both ways, against std::stable_sort: the result must be equal to the bit.
#include "core/error.h"
#include "gl/gl_test.h"
#include "gl/sort_inputs.h"
#include "gpu/program.h"
#include "sort/radix_sort.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace sorting;
using gpu::Buffer;
using Kind = gpu::Traffic::Kind;
using Way = RadixSort::Way;

namespace {

bool hasCompute() {
    if (!testContext().info().computeShaders) WARN("skipped: this context has no compute shaders");
    return testContext().info().computeShaders;
}

Pairs sortedBy(RadixSort& sort, const Pairs& input, size_t count, int keyBits) {
    Buffer pairs(testContext(), Buffer::Use::storage, std::span<const Pair>(input), "pairs");
    sort.sort(pairs, count, keyBits);
    Pairs out(input.size());
    pairs.download(Kind::state, 0, out.data(), pairs.bytes());
    return out;
}

}  // namespace

TEST_CASE("radix sort by pieces equals a stable sort at every size", "[sort]") {
    if (!hasCompute()) return;
    RadixSort sort(testContext(), 3000, Way::pieces);
    for (size_t count = 1; count <= 130; ++count) {
        const Pairs input = randomPairs(count, uint32_t(count));
        INFO(count << " pairs");
        REQUIRE(sortedBy(sort, input, count, 32) == sorted(input));
    }
    for (const size_t count : {1023, 1024, 1025, 2047, 2048, 2049, 3000}) {
        for (const Input& input : inputs(count, 1)) {
            INFO(count << " pairs, " << input.name);
            REQUIRE(sortedBy(sort, input.pairs, count, 32) == sorted(input.pairs));
        }
    }
    testContext().checkErrors("radix sort");
}

TEST_CASE("radix sort by tiles equals a stable sort around the size of a tile", "[sort]") {
    if (!hasCompute()) return;
    RadixSort sort(testContext(), 5000, Way::tiles);
    for (const size_t count : {1, 2, 7, 8, 9, 255, 257, 2047, 2048, 2049, 4096, 5000}) {
        const Pairs input = randomPairs(count, uint32_t(count));
        INFO(count << " pairs");
        REQUIRE(sortedBy(sort, input, count, 32) == sorted(input));
    }
    for (const Input& input : inputs(2500, 1)) {
        INFO(input.name);
        REQUIRE(sortedBy(sort, input.pairs, 2500, 32) == sorted(input.pairs));
    }
    testContext().checkErrors("radix sort");
}

TEST_CASE("radix sort counts only the low bits of a key, and keeps the others", "[sort]") {
    if (!hasCompute()) return;
    for (const Way way : {Way::pieces, Way::tiles}) {
        RadixSort sort(testContext(), 700, way);
        const Pairs input = randomPairs(700, 5);
        for (const int bits : {0, 1, 3, 4, 5, 8, 9, 11, 12, 16, 17, 22, 23, 31}) {
            INFO((way == Way::pieces ? "pieces, " : "tiles, ") << bits << " bits");
            REQUIRE(sortedBy(sort, input, 700, bits) == sorted(input, bits));
        }
    }
}

TEST_CASE("radix sort of a part leaves the rest of the buffer alone", "[sort]") {
    if (!hasCompute()) return;
    for (const Way way : {Way::pieces, Way::tiles}) {
        RadixSort sort(testContext(), 4096, way);
        const Pairs input = randomPairs(4096, 6);
        for (const size_t count : {0, 1, 2, 1000, 4095}) {
            Pairs expected = sorted(Pairs(input.begin(), input.begin() + long(count)), 24);
            expected.insert(expected.end(), input.begin() + long(count), input.end());
            REQUIRE(sortedBy(sort, input, count, 24) == expected);
        }
    }
}

TEST_CASE("radix sort of many pairs, in digits of 11 bits, and again to the bit", "[sort]") {
    if (!hasCompute()) return;
    const size_t count = 70001;
    RadixSort sort(testContext(), count, Way::pieces);
    CHECK(sort.passes(count, 32) == 3);
    CHECK(sort.passes(count, 17) == 2);
    CHECK(sort.passes(1000, 32) == 4);
    CHECK(sort.passes(1, 32) == 0);
    for (const int bits : {17, 32}) {
        const Pairs input = randomPairs(count, 7);
        const Pairs once = sortedBy(sort, input, count, bits);
        REQUIRE(once == sorted(input, bits));
        REQUIRE(sortedBy(sort, input, count, bits) == once);
    }
}

TEST_CASE("radix sort of more pairs than a lane can go over at once", "[sort]") {
    if (!hasCompute()) return;
    // with 32 lanes 62,500 turns and those over the digits would be more than Mesa's rasterisers take
    for (const size_t count : {size_t(2000000), size_t(40 * 61436), size_t(40 * 61436 + 1)}) {
        RadixSort sort(testContext(), count, Way::pieces);
        const Pairs input = randomPairs(count, 9);
        REQUIRE((sortedBy(sort, input, count, 32) == sorted(input)));
    }
}

TEST_CASE("radix sort of more tiles than a workgroup adds up at once", "[sort]") {
    if (!hasCompute()) return;
    const size_t count = 256 * 2048 + 4001;
    RadixSort sort(testContext(), count, Way::tiles);
    const Pairs input = randomPairs(count, 8);
    REQUIRE((sortedBy(sort, input, count, 7) == sorted(input, 7)));
}

TEST_CASE("radix sort sees what a shader wrote, and moves nothing over the bus", "[sort]") {
    if (!hasCompute()) return;
    gpu::ProgramOptions options;
    options.compute = "fill.comp";
    options.generated = {{"fill.comp",
                          "layout(local_size_x = 64) in;\n"
                          "layout(std430) writeonly buffer Pairs { uvec2 pairs[]; };\n"
                          "void main() {\n"
                          "    uint i = gl_GlobalInvocationID.x;\n"
                          "    pairs[i] = uvec2((i * 7919u) % 4096u, i);\n"
                          "}\n"}};
    const gpu::Program fill(testContext(), options);
    RadixSort sort(testContext(), 4096);
    Buffer pairs(testContext(), Buffer::Use::storage, nullptr, 4096 * sizeof(Pair), "pairs");
    const gpu::Traffic before = testContext().traffic();
    fill.use();
    fill.storage("Pairs", pairs, 0, pairs.bytes());
    fill.dispatch(64);
    sort.sort(pairs, 4096, 12);
    const gpu::Traffic moved = testContext().traffic() - before;
    for (const Kind kind : {Kind::state, Kind::parameters, Kind::control})
        CHECK(moved.total(kind) == 0);
    Pairs out(4096);
    pairs.download(Kind::state, 0, out.data(), pairs.bytes());
    for (uint32_t i = 0; i < 4096; ++i)
        REQUIRE(out[i].key == i);
}

TEST_CASE("radix sort refuses what the context cannot hold", "[sort]") {
    const gpu::ContextInfo& info = testContext().info();
    const size_t most = RadixSort::most(info);
    if (!info.computeShaders) {
        CHECK(most == 0);
        CHECK(messageOf([] { RadixSort(testContext(), 10); }) ==
              concat("radix sort needs compute shaders, OpenGL 4.3; this context has ", info.major, ".",
                     info.minor));
        return;
    }
    CHECK(most >= size_t(1) << 20);
    CHECK(most * sizeof(Pair) <= size_t(info.maxStorageBlockBytes));
    CHECK(messageOf([&] { RadixSort(testContext(), most + 1); }) ==
          concat("radix sort of ", most + 1, " pairs is larger than this context can hold: ", most));
}
