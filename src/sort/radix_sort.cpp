#include "sort/radix_sort.h"

#include <algorithm>
#include <climits>
#include <thread>
#include <utility>

#include "core/contract.h"
#include "core/error.h"
#include "gpu/buffer.h"

namespace shoal {

using gpu::Barrier;
using gpu::Buffer;
using gpu::Program;

namespace {

constexpr size_t pairBytes = 2 * sizeof(uint32_t);
constexpr int simdLanes = 8;  // of a workgroup of pieces: what a CPU rasteriser runs in step
constexpr int tileLanes = 256, tilePairs = 2048;
constexpr int tileDigitBits = 8, pieceDigitBits = 11;
// A piece is a loop, after two over the digits; each is counted once more than it turns.
constexpr size_t longestPiece = size_t(gpu::mostSoftwareTurns) - 2 * ((size_t(1) << pieceDigitBits) + 1) - 1;
// Fewer pairs than these are not worth the work on 2,048 counters a lane.
constexpr size_t manyPairs = size_t(1) << 16;

int dividedUp(size_t value, size_t divisor) {
    return int((value + divisor - 1) / divisor);
}

Program compute(gpu::Context& context, const char* file, int lanes, int digitBits) {
    gpu::ProgramOptions options;
    options.compute = file;
    options.label = file;
    options.defines = {concat("LANES ", lanes), concat("MOST_DIGITS ", 1 << digitBits),
                       concat("TILE_PAIRS ", tilePairs)};
    return {context, options};
}

size_t checkedCapacity(const gpu::ContextInfo& info, size_t capacity) {
    if (!info.computeShaders)
        throw Error(concat("radix sort needs compute shaders, OpenGL 4.3; this context has ", info.major, ".",
                           info.minor));
    const size_t most = RadixSort::most(info);
    if (capacity <= most) return std::max<size_t>(capacity, 1);
    throw Error(concat("radix sort of ", capacity, " pairs is larger than this context can hold: ", most));
}

}  // namespace

size_t RadixSort::most(const gpu::ContextInfo& info) {
    if (!info.computeShaders) return 0;
    size_t most = size_t(info.maxStorageBlockBytes) / pairBytes;
    most = std::min(most, size_t(info.maxBufferTexels));
    most = std::min(most, size_t(info.maxWorkGroupsX) * tilePairs);
    return std::min(most, size_t(INT_MAX - tilePairs));  // shaders count in int
}

RadixSort::RadixSort(gpu::Context& context, size_t capacity, Way way)
    : context_(&context),
      capacity_(checkedCapacity(context.info(), capacity)),
      tiles_(way == Way::tiles || (way == Way::automatic && !context.info().software)),
      // Twice as many workgroups as cores, which evens out what one of them waits for.
      mostLanes_(simdLanes * 2 * int(std::clamp(std::thread::hardware_concurrency(), 1u, 32u))) {
    // Only as many counters as it takes: Mesa needs 2.4 s to link a shader with 2,048.
    const int digitBits = digitBitsMost(capacity_);
    const auto make = [&](const char* file, int lanes) { return compute(context, file, lanes, digitBits); };
    count_ = tiles_ ? make("sort/tiles_count.comp", tileLanes) : make("sort/pieces_count.comp", simdLanes);
    scan_ = tiles_ ? make("sort/tiles_scan.comp", tileLanes) : make("sort/pieces_scan.comp", simdLanes);
    scatter_ =
        tiles_ ? make("sort/tiles_scatter.comp", tileLanes) : make("sort/pieces_scatter.comp", simdLanes);

    const size_t digits = size_t(1) << digitBits;
    const auto most = size_t(std::max(parts(capacity_, int(digits)), tiles_ ? 0 : mostLanes_));
    const auto storage = [&](size_t bytes, const char* label) {
        return Buffer(context, Buffer::Use::storage, nullptr, bytes, label);
    };
    other_ = storage(capacity_ * pairBytes, "sorted pairs");
    counts_ = storage(digits * most * sizeof(uint32_t), "digit counts");
    totals_ = storage(digits * sizeof(uint32_t), "digit totals");
}

int RadixSort::digitBitsMost(size_t count) const {
    return !tiles_ && count >= manyPairs ? pieceDigitBits : tileDigitBits;
}

int RadixSort::passes(size_t count, int keyBits) const {
    return count < 2 ? 0 : dividedUp(size_t(keyBits), size_t(digitBitsMost(count)));
}

// A piece is several times as long as its lane has counters, which it clears, writes and reads.
int RadixSort::parts(size_t count, int digits) const {
    if (tiles_) return dividedUp(count, tilePairs);
    const auto wholeGroups = [](int lanes) { return dividedUp(size_t(lanes), simdLanes) * simdLanes; };
    const int lanes = std::min(dividedUp(count, size_t(4 * digits)), mostLanes_);
    return std::max(wholeGroups(lanes), wholeGroups(dividedUp(count, longestPiece)));
}

void RadixSort::setPass(const Program& program, const Pass& pass) const {
    program.use();
    program.set("digits", pass.digits);
    program.set("parts", pass.parts);
    program.storage("Counts", counts_);
    if (&program == &scan_) return;
    program.set("count", pass.count);
    program.set("shift", pass.shift);
    if (!tiles_) program.set("piece", dividedUp(size_t(pass.count), size_t(pass.parts)));
}

void RadixSort::run(const Buffer& from, const Buffer& to, const Pass& pass) {
    const size_t bytes = size_t(pass.count) * pairBytes;
    gpu::BufferTexture texels;
    if (!tiles_) texels = {*context_, from, "pairs", 0, bytes, gpu::Texel::uint2};
    const auto bindPairs = [&](const Program& program) {
        if (tiles_)
            program.storage("Pairs", from, 0, bytes);
        else
            program.texture("pairs", texels);
    };
    const int groups = tiles_ ? pass.parts : pass.parts / simdLanes;

    gpu::barrier({Barrier::textureFetch, Barrier::storage});
    setPass(count_, pass);
    bindPairs(count_);
    count_.dispatch(groups);

    gpu::barrier({Barrier::storage});
    setPass(scan_, pass);
    scan_.storage("Totals", totals_);
    scan_.dispatch(tiles_ ? pass.digits : dividedUp(size_t(pass.digits), simdLanes));

    gpu::barrier({Barrier::storage});
    setPass(scatter_, pass);
    bindPairs(scatter_);
    scatter_.storage("Totals", totals_);
    scatter_.storage("Sorted", to, 0, bytes);
    scatter_.dispatch(groups);
}

void RadixSort::sort(Buffer& pairs, size_t count, int keyBits) {
    EXPECTS(count <= capacity_ && count * pairBytes <= pairs.bytes() && keyBits >= 0 && keyBits <= 32);
    const int passCount = passes(count, keyBits);
    Buffer* from = &pairs;
    Buffer* to = &other_;
    for (int i = 0, shift = 0; i < passCount; ++i) {
        // As even as can be: 17 bits are 9 and 8.
        const int bits = dividedUp(size_t(keyBits - shift), size_t(passCount - i));
        run(*from, *to, {int(count), parts(count, 1 << bits), 1 << bits, shift});
        std::swap(from, to);
        shift += bits;
    }
    if (from != &pairs) from->copyTo(pairs, count * pairBytes);
    gpu::barrier({Barrier::textureFetch, Barrier::storage});
}

}  // namespace shoal
