#include "simulate/buffer_state.h"

#include "compile/pack.h"
#include "core/contract.h"
#include "core/error.h"
#include "gpu/program.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace shoal {

using gpu::Buffer;
using gpu::BufferTexture;
using gpu::Traffic;

namespace {

// The vertices' floats of `count` molecules in 4-vectors, from 4-vector `first` of `elements` a molecule.
void pack(const BufferLayout& layout, const std::vector<glm::vec3>& values, int first, int elements,
          std::vector<glm::vec4>& out) {
    const size_t vertices = size_t(layout.vertexCount);
    for (size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const int number = int(i % vertices) * 3 + c;
            out[BufferLayout::index(i / vertices, first + number / 4, elements)][number % 4] = values[i][c];
        }
    }
}

std::vector<glm::vec3> unpack(const BufferLayout& layout, const std::vector<glm::vec4>& packed, int first,
                              int elements, size_t molecules) {
    const size_t vertices = size_t(layout.vertexCount);
    std::vector<glm::vec3> values(molecules * vertices);
    for (size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const int number = int(i % vertices) * 3 + c;
            values[i][c] =
                packed[BufferLayout::index(i / vertices, first + number / 4, elements)][number % 4];
        }
    }
    return values;
}

// A state that another solver or path has left behind has none.
void packHistory(const BufferLayout& layout, const GroupState& state, std::vector<glm::vec4>& out) {
    const int part = layout.positionElements(), elements = layout.stateElements();
    if (!state.displacements.empty()) {
        pack(layout, state.displacements, 2 * part, elements, out);
        pack(layout, state.velocityChanges, 3 * part, elements, out);
        return;
    }
    for (size_t m = 0; m < state.anchors.size(); ++m)
        out[BufferLayout::index(m, 2 * part, elements)].x = noHistory;
}

// Lanes past the last molecule do what it does, so that they never do anything worse.
void repeatLast(std::vector<glm::vec4>& packed, int elements, size_t count) {
    for (size_t m = count; m < packed.size() / size_t(elements); ++m)
        for (int e = 0; e < elements; ++e)
            packed[BufferLayout::index(m, e, elements)] = packed[BufferLayout::index(count - 1, e, elements)];
}

// Where age, and where length of life lie: the 4-vector of a molecule, and which of its numbers.
struct LifeAt {
    int element;
    int component;
};
LifeAt ageAt(const BufferLayout& layout) {
    if (layout.lifeApart()) return {layout.stateElements() - 1, 0};
    return {layout.positionElements() - 1, 3};
}
LifeAt spanAt(const BufferLayout& layout) {
    if (layout.lifeApart()) return {layout.stateElements() - 1, 1};
    return {2 * layout.positionElements() - 1, 3};
}

void packLives(const BufferLayout& layout, const std::vector<glm::vec2>& lives, std::vector<glm::vec4>& out) {
    const int elements = layout.stateElements();
    const LifeAt age = ageAt(layout), span = spanAt(layout);
    for (size_t m = 0; m < lives.size(); ++m) {
        out[BufferLayout::index(m, age.element, elements)][age.component] = lives[m].x;
        out[BufferLayout::index(m, span.element, elements)][span.component] = lives[m].y;
    }
}

std::vector<glm::vec2> unpackLives(const BufferLayout& layout, const std::vector<glm::vec4>& packed,
                                   size_t count) {
    const int elements = layout.stateElements();
    const LifeAt age = ageAt(layout), span = spanAt(layout);
    std::vector<glm::vec2> out;
    for (size_t m = 0; m < count; ++m)
        out.emplace_back(packed[BufferLayout::index(m, age.element, elements)][age.component],
                         packed[BufferLayout::index(m, span.element, elements)][span.component]);
    return out;
}

std::vector<glm::vec4> download(const Buffer& buffer) {
    std::vector<glm::vec4> out(buffer.bytes() / sizeof(glm::vec4));
    buffer.download(Traffic::Kind::state, 0, out.data(), buffer.bytes());
    return out;
}

Buffer makeBuffer(gpu::Context& context, const GroupPlan& group, size_t elements, const char* what) {
    try {
        return Buffer(context, Buffer::Use::storage, nullptr, elements * sizeof(glm::vec4),
                      concat(what, " of ", group.name).c_str());
    } catch (const gpu::OutOfMemory& error) {
        throw gpu::OutOfMemory(group.location,
                               concat(error.message(), ", for ", many(group.count, "molecule", "molecules")));
    }
}

}  // namespace

GroupBuffers::GroupBuffers(gpu::Context& context, const GroupPlan& group, bool normals, bool inPlace,
                           size_t largestPart)
    : layout_(group.layout()),
      molecules_(layout_.padded(size_t(group.count))),
      inPlace_(inPlace),
      seeds_(group.constants.seeds) {
    state_[0] = makeBuffer(context, group, molecules_ * size_t(layout_.stateElements()), "state");
    if (!inPlace)
        state_[1] = makeBuffer(context, group, molecules_ * size_t(layout_.stateElements()), "state");
    records_ = makeBuffer(context, group, molecules_, "records");
    if (normals && group.needs.normals)
        normals_ = makeBuffer(context, group, molecules_ * size_t(layout_.positionElements()), "normals");
    if (group.needs.scale || group.needs.phase) {
        std::vector<glm::vec4> constants(molecules_);
        for (size_t m = 0; m < group.constants.scales.size(); ++m)
            constants[m] = glm::vec4(group.constants.scales[m], group.constants.phases[m], 0, 0);
        repeatLast(constants, 1, size_t(group.count));
        constants_ = makeBuffer(context, group, molecules_, "constants");
        constants_.update(Traffic::Kind::parameters, 0, constants.data(), constants_.bytes());
    }
    if (group.needs.steers) steering_ = makeBuffer(context, group, molecules_ * steeringElements, "steering");
    split(context, largestPart);
    parts_.back().count = group.count - parts_.back().first;
}

GroupBuffers::Range GroupBuffers::rangeOf(const Part& part, const Buffer& buffer, int elements) const {
    const size_t bytes = size_t(elements) * sizeof(glm::vec4);
    return {&buffer, size_t(part.first) * bytes, layout_.padded(size_t(part.count)) * bytes};
}

// Parts are whole workgroups, so that the molecules of a part are one range of every buffer.
void GroupBuffers::split(gpu::Context& context, size_t largestPart) {
    const gpu::ContextInfo& info = context.info();
    const auto alignment = size_t(std::max({1, info.textureBufferAlignment, info.storageBufferAlignment}));
    // molecules whose records end on a multiple of the alignment; a block of the state always does
    const size_t unit = std::lcm(size_t(layout_.lanes()), std::max<size_t>(1, alignment / sizeof(glm::vec4)));
    const size_t elements = size_t(layout_.stateElements());
    size_t most =
        std::min(size_t(info.maxBufferTexels), size_t(info.maxStorageBlockBytes) / sizeof(glm::vec4)) /
        elements;
    if (largestPart > 0) most = std::min(most, largestPart);
    most = std::max(most / unit, size_t(1)) * unit;
    for (size_t first = 0; first < molecules_; first += most) {
        Part part;
        part.first = int(first);
        part.count = int(std::min(most, molecules_ - first));
        const auto texture = [&](const Buffer& buffer, int count, const char* label) {
            const Range range = rangeOf(part, buffer, count);
            return BufferTexture(context, buffer, label, range.offset, range.bytes);
        };
        for (size_t side = 0; side < (inPlace_ ? 1u : 2u); ++side)
            part.state[side] = texture(state_[side], layout_.stateElements(), "state");
        part.record = texture(records_, 1, "records");
        if (constants_) part.constant = texture(constants_, 1, "constants");
        if (steering_) part.steering = texture(steering_, steeringElements, "steering");
        if (normals_) part.normal = texture(normals_, layout_.positionElements(), "normals");
        parts_.push_back(std::move(part));
    }
}

void store(const gpu::Program& program, const char* block, int binding, const GroupBuffers::Range& range) {
    program.storage(block, binding, *range.buffer, range.offset, range.bytes);
}

void GroupBuffers::write(const GroupPlan& group, const GroupState& state) {
    const int elements = layout_.stateElements();
    std::vector<glm::vec4> packed(molecules_ * size_t(elements));
    pack(layout_, state.positions, 0, elements, packed);
    pack(layout_, state.velocities, layout_.positionElements(), elements, packed);
    if (layout_.history) packHistory(layout_, state, packed);
    // lanes past the last place are free places for ever
    if (layout_.life)
        packLives(layout_, state.lives, packed);
    else
        repeatLast(packed, elements, size_t(group.count));
    state_[size_t(current_)].update(Traffic::Kind::state, 0, packed.data(),
                                    packed.size() * sizeof(glm::vec4));
    std::vector<glm::vec4> records(molecules_);
    const std::vector<uint32_t>& seeds = state.seeds.empty() ? seeds_ : state.seeds;
    for (size_t m = 0; m < size_t(group.count); ++m) {
        const float label = float(seeds[m] + 1);
        records[m] = glm::vec4(state.anchors[m], state.released[m] ? -label : label);
    }
    // a record is one element, and one element of a block of molecules lies as they are counted
    repeatLast(records, 1, size_t(group.count));
    records_.update(Traffic::Kind::state, 0, records.data(), records_.bytes());
    if (steering_) {
        // what another plan's state does not have
        std::vector<glm::vec4> steering = unsteered(molecules_);
        std::copy(state.steering.begin(), state.steering.end(), steering.begin());
        steering_.update(Traffic::Kind::state, 0, steering.data(), steering_.bytes());
    }
    if (constants_ && !state.looks.empty()) {
        std::vector<glm::vec4> looks(molecules_);
        for (size_t m = 0; m < state.looks.size(); ++m)
            looks[m] = glm::vec4(state.looks[m], 0, 0);
        constants_.update(Traffic::Kind::state, 0, looks.data(), constants_.bytes());
    }
}

GroupState GroupBuffers::read(const GroupPlan& group) const {
    return readSide(group, state_[size_t(current_)]);
}

GroupState GroupBuffers::readBefore(const GroupPlan& group) const {
    EXPECTS(!inPlace_);
    return readSide(group, state_[size_t(1 - current_)]);
}

GroupState GroupBuffers::readSide(const GroupPlan& group, const Buffer& side) const {
    const int elements = layout_.stateElements();
    const size_t count = size_t(group.count);
    const std::vector<glm::vec4> packed = download(side);
    GroupState state;
    state.positions = unpack(layout_, packed, 0, elements, count);
    state.velocities = unpack(layout_, packed, layout_.positionElements(), elements, count);
    if (layout_.history) {
        state.displacements = unpack(layout_, packed, 2 * layout_.positionElements(), elements, count);
        state.velocityChanges = unpack(layout_, packed, 3 * layout_.positionElements(), elements, count);
    }
    const std::vector<glm::vec4> records = download(records_);
    for (size_t m = 0; m < count; ++m) {
        state.anchors.emplace_back(records[m]);
        state.released.push_back(std::signbit(records[m].w));
    }
    if (steering_) {
        state.steering = download(steering_);
        state.steering.resize(count * steeringElements);
    }
    if (layout_.life) {
        state.lives = unpackLives(layout_, packed, count);
        for (size_t m = 0; m < count; ++m)
            state.seeds.push_back(records[m].w == 0 ? 0 : uint32_t(std::abs(records[m].w)) - 1);
        const std::vector<glm::vec4> looks =
            constants_ ? download(constants_) : std::vector<glm::vec4>(count, glm::vec4(1, 0, 0, 0));
        for (size_t m = 0; m < count; ++m)
            state.looks.emplace_back(looks[m].x, looks[m].y);
    }
    return state;
}

GroupState GroupBuffers::readOne(size_t molecule) const {
    const int elements = layout_.stateElements();
    const size_t block = size_t(BufferLayout::block), lane = molecule % block;
    const auto read = [&](const Buffer& buffer, int each) {
        std::vector<glm::vec4> out(block * size_t(each));
        const size_t bytes = out.size() * sizeof(glm::vec4);
        buffer.download(Traffic::Kind::state, molecule / block * bytes, out.data(), bytes);
        return out;
    };
    const std::vector<glm::vec4> packed = read(state_[size_t(current_)], elements);
    const auto ownVertices = [&](int first) {
        const std::vector<glm::vec3> all = unpack(layout_, packed, first, elements, block);
        const size_t vertices = size_t(layout_.vertexCount);
        const auto begin = all.begin() + std::ptrdiff_t(lane * vertices);
        return std::vector<glm::vec3>(begin, begin + std::ptrdiff_t(vertices));
    };
    GroupState out;
    out.positions = ownVertices(0);
    out.velocities = ownVertices(layout_.positionElements());
    const glm::vec4 record = read(records_, 1)[lane];
    out.anchors.emplace_back(record);
    out.released.push_back(std::signbit(record.w));
    if (layout_.life) out.lives.push_back(unpackLives(layout_, packed, block)[lane]);
    out.looks.emplace_back(constants_ ? glm::vec2(read(constants_, 1)[lane]) : glm::vec2(1, 0));
    return out;
}

std::vector<glm::vec3> GroupBuffers::readNormals(const GroupPlan& group) const {
    return unpack(layout_, download(normals_), 0, layout_.positionElements(), size_t(group.count));
}

}  // namespace shoal
