#include "sort/network_sort.h"

#include <algorithm>
#include <bit>
#include <climits>

#include "core/contract.h"
#include "core/error.h"
#include "gpu/gl.h"

namespace shoal {

std::vector<OddEvenPass> oddEvenMergePasses(size_t count) {
    std::vector<OddEvenPass> out;
    for (size_t run = 1; run < count; run *= 2) {
        for (size_t distance = run; distance >= 1; distance /= 2)
            out.push_back({int(run), int(distance)});
    }
    return out;
}

std::vector<BitonicPass> bitonicPasses(size_t block) {
    EXPECTS(std::has_single_bit(block));
    if (block == 2) return {{0, false, true, false}};
    std::vector<BitonicPass> out;
    for (size_t merged = 4; merged <= block; merged *= 2) {  // elements
        size_t mask = merged / 2 - 1;                        // texels
        out.push_back({int(mask), true, merged == 4, false});
        for (mask = merged / 8; mask >= 1; mask /= 2)
            out.push_back({int(mask), false, false, false});
        out.back().last = true;
    }
    return out;
}

namespace {

int pairsInTexel(NetworkSort::Kind kind) {
    return kind == NetworkSort::Kind::bitonic ? 2 : 1;
}

const char* name(NetworkSort::Kind kind) {
    return kind == NetworkSort::Kind::bitonic ? "bitonic sort" : "odd-even merge sort";
}

size_t checkedCapacity(const gpu::ContextInfo& info, NetworkSort::Kind kind, size_t capacity) {
    const size_t most = NetworkSort::most(info, kind);
    if (capacity <= most) return std::max<size_t>(capacity, 1);
    throw Error(concat(name(kind), " of ", capacity, " pairs is larger than this context can hold: ", most));
}

int chosenRowLength(const gpu::ContextInfo& info, NetworkSort::Kind kind, size_t capacity, int wanted) {
    const size_t widest = std::bit_floor(size_t(info.maxTextureSize)) * size_t(pairsInTexel(kind));
    size_t length = 2;
    if (wanted != 0) {
        length = size_t(wanted);
    } else {
        while (length * length < capacity)
            length *= 2;
        length = std::min(length, widest);
    }
    EXPECTS(length >= 2 && std::has_single_bit(length) && "rows are a power of two long");
    const size_t rows = (capacity + length - 1) / length;
    if (length <= widest && rows <= size_t(info.maxTextureSize)) return int(length);
    throw Error(concat(name(kind), " of ", capacity, " pairs in rows of ", length,
                       " does not fit into a texture of this context, of at most ", info.maxTextureSize,
                       " x ", info.maxTextureSize, " texels"));
}

}  // namespace

size_t NetworkSort::most(const gpu::ContextInfo& info, Kind kind) {
    const auto size = size_t(info.maxTextureSize);
    return std::min(std::bit_floor(size) * size_t(pairsInTexel(kind)) * size, size_t(INT_MAX / 2));
}

NetworkSort::NetworkSort(gpu::Context& context, Kind kind, size_t capacity, int rowLength, Ties ties)
    : kind_(kind),
      capacity_(checkedCapacity(context.info(), kind, capacity)),
      count_(capacity_),
      rowLength_(chosenRowLength(context.info(), kind, capacity_, rowLength)) {
    const gpu::Format format = kind == Kind::bitonic ? gpu::Format::rgba32ui : gpu::Format::rg32ui;
    for (int i = 0; i < 2; ++i) {
        sides_[i] = gpu::Texture(context, format, rowLength_ / pairsInTexel(kind), rows(), "sorted pairs");
        targets_[i] = gpu::Framebuffer(context, {&sides_[i]}, nullptr, "sorted pairs");
    }
    gpu::ProgramOptions options;
    options.vertex = "passes/fullscreen.vert";
    options.fragment = kind == Kind::bitonic ? "sort/bitonic.frag" : "sort/odd_even_merge.frag";
    options.label = name(kind);
    EXPECTS(ties == Ties::any || kind == Kind::bitonic);
    if (ties == Ties::byIndex) options.defines.emplace_back("TIES_BY_INDEX");
    program_ = gpu::Program(context, options);
}

void NetworkSort::setCount(size_t count) {
    EXPECTS(count <= capacity_);
    count_ = count;
    spread_.clear();
}

int NetworkSort::passes() const {
    if (count_ < 2) return 0;
    return int(kind_ == Kind::bitonic ? bitonicPasses(std::bit_ceil(count_)).size()
                                      : oddEvenMergePasses(count_).size());
}

std::vector<KeyIndex> NetworkSort::download() const {
    std::vector<KeyIndex> out(size_t(rows()) * size_t(rowLength_));
    if (!out.empty())
        pairs().download(gpu::Traffic::Kind::state, 0, 0, pairs().width(), rows(), out.data(),
                         out.size() * sizeof(KeyIndex));
    out.resize(count_);
    return out;
}

void NetworkSort::drawInto(const gpu::Framebuffer& target) const {
    gpu::drawPlainly();
    target.bind(0, 0, target.width(), rows());
}

void NetworkSort::begin() const {
    drawInto(targets_[1 - side_]);
    program_.use();
    program_.set("count", int(count_));
}

void NetworkSort::run(const OddEvenPass& pass) {
    targets_[1 - side_].bind(0, 0, sides_[0].width(), rows());
    program_.texture("pairs", pairs());
    program_.set("rowBits", std::countr_zero(unsigned(rowLength_)));
    program_.set("run", pass.run);
    program_.set("reach", pass.distance);
    gpu::drawVertices(3);
    flip();
}

void NetworkSort::run(const BitonicPass& pass) {
    targets_[1 - side_].bind(0, 0, sides_[0].width(), rows());
    const int width = sides_[0].width();
    program_.texture("pairs", pairs());
    program_.set("mask", glm::ivec2(pass.mask % width, pass.mask / width));
    program_.set("crossed", int(pass.crossed));
    program_.set("sortedBefore", int(pass.first));
    program_.set("sortedAfter", int(pass.last));
    gpu::drawVertices(3);
    flip();
}

void NetworkSort::sort() {
    if (count_ < 2) return;
    begin();
    if (kind_ == Kind::bitonic) {
        for (const BitonicPass& pass : bitonicPasses(std::bit_ceil(count_)))
            run(pass);
    } else {
        for (const OddEvenPass& pass : oddEvenMergePasses(count_))
            run(pass);
    }
}

void NetworkSort::sortRows() {
    EXPECTS(kind_ == Kind::bitonic);
    if (count_ < 2) return;
    begin();
    for (const BitonicPass& pass : bitonicPasses(size_t(rowLength_)))
        run(pass);
}

void NetworkSort::beginSpread(int frames) {
    EXPECTS(kind_ == Kind::oddEvenMerge && frames >= 1);
    spread_ = oddEvenMergePasses(count_);
    frames_ = frames;
    frame_ = 0;
}

void NetworkSort::advance() {
    EXPECTS(kind_ == Kind::oddEvenMerge);
    if (spread_.empty()) return;  // one pair, or none
    const auto passesBefore = [&](int frame) { return spread_.size() * size_t(frame) / size_t(frames_); };
    begin();
    for (size_t i = passesBefore(frame_); i < passesBefore(frame_ + 1); ++i)
        run(spread_[i]);
    frame_ = (frame_ + 1) % frames_;
}

}  // namespace shoal
