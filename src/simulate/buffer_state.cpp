#include "simulate/buffer_state.h"

#include "compile/newton.h"
#include "core/contract.h"
#include "core/error.h"
#include "core/memory.h"
#include "gpu/program.h"

#include <algorithm>
#include <numeric>

namespace shoal {

using gpu::Buffer;
using gpu::BufferTexture;
using gpu::Traffic;

namespace {

constexpr size_t mostNumbers = size_t(128) << 20;  // bytes of matrices that are worked on

Buffer makeBuffer(gpu::Context& context, const GroupPlan& group, size_t elements, const char* what) {
    try {
        return Buffer(context, Buffer::Use::storage, nullptr, elements * sizeof(glm::vec4),
                      concat(what, " of ", group.name).c_str());
    } catch (const gpu::OutOfMemory& error) {
        throw gpu::OutOfMemory(group.location,
                               concat(error.message(), ", for ", many(group.count, "molecule", "molecules")));
    }
}

// A CPU rasteriser takes its memory from the machine, which grants more than it has and kills the process
// that uses it.
void checkMemory(const gpu::Context& context, const GroupPlan& group, size_t elements) {
    if (!context.info().software) return;
    const auto each = int64_t(elements * sizeof(glm::vec4));
    const int64_t free = availableMemory();
    if (group.count <= free / each) return;
    throw gpu::OutOfMemory(
        group.location, concat(many(group.count, "molecule", "molecules"), " of \"", group.name, "\" take ",
                               (group.count * each) >> 20, " MiB; ", free >> 20,
                               " MiB of memory are free: at most ", free / each, " such molecules fit"));
}

}  // namespace

GroupBuffers::GroupBuffers(gpu::Context& context, const GroupPlan& group, bool normals, bool inPlace,
                           int together, size_t largestPart)
    : PackedState(group, group.layout().padded(size_t(group.count)), BufferLayout::block),
      inPlace_(inPlace),
      numbers_(solver(group.solver).spread ? newtonNumbers(group) : 0),
      together_(together) {
    const auto make = [&](Values values, const char* what) {
        return makeBuffer(context, group, molecules() * size_t(elements(values)), what);
    };
    const bool constants = group.needs.scale || group.needs.phase;
    size_t all = size_t(elements(Values::state)) * (inPlace ? 1 : 2) + 1 + (constants ? 1 : 0);
    if (normals && group.needs.normals) all += size_t(elements(Values::normals));
    if (group.needs.steers) all += size_t(steeringElements);
    checkMemory(context, group, all);
    state_[0] = make(Values::state, "state");
    if (!inPlace) state_[1] = make(Values::state, "state");
    records_ = make(Values::records, "records");
    if (normals && group.needs.normals) normals_ = make(Values::normals, "normals");
    if (constants) {
        constants_ = make(Values::constants, "constants");
        writeConstants(group);
    }
    if (group.needs.steers) steering_ = make(Values::steering, "steering");
    split(context, largestPart);
    parts_.back().count = group.count - parts_.back().first;
    if (numbers_ == 0) return;
    const auto most = std::max_element(parts_.begin(), parts_.end(),
                                       [](const Part& a, const Part& b) { return a.count < b.count; });
    const size_t molecules = size_t(workgroups(*most)) * size_t(together_);
    matrixNumbers_ =
        Buffer(context, Buffer::Use::storage, nullptr, molecules * size_t(numbers_) * sizeof(double),
               concat("matrix of ", group.name).c_str());
}

GroupBuffers::Range GroupBuffers::rangeOf(const Part& part, const Buffer& buffer, int elements) const {
    const size_t bytes = size_t(elements) * sizeof(glm::vec4);
    return {&buffer, size_t(part.first) * bytes, layout().padded(size_t(part.count)) * bytes};
}

// Parts are whole workgroups, so that the molecules of a part are one range of every buffer.
void GroupBuffers::split(gpu::Context& context, size_t largestPart) {
    const gpu::ContextInfo& info = context.info();
    const auto alignment = size_t(std::max({1, info.textureBufferAlignment, info.storageBufferAlignment}));
    // molecules whose records end on a multiple of the alignment; a block of the state always does
    size_t unit = std::lcm(size_t(layout().lanes()), std::max<size_t>(1, alignment / sizeof(glm::vec4)));
    if (layout().life) unit = std::lcm(unit, size_t(32));  // whole words of bits
    const size_t elements = size_t(layout().stateElements());
    size_t most =
        std::min(size_t(info.maxBufferTexels), size_t(info.maxStorageBlockBytes) / sizeof(glm::vec4)) /
        elements;
    most = std::min(most, size_t(info.maxWorkGroupsX) * size_t(together_));
    if (numbers_ > 0)
        most = std::min(most, std::min(size_t(info.maxStorageBlockBytes), mostNumbers) /
                                  (size_t(numbers_) * sizeof(double)));
    if (largestPart > 0) most = std::min(most, largestPart);
    most = std::max(most / unit, size_t(1)) * unit;
    for (size_t first = 0; first < molecules(); first += most) {
        Part part;
        part.first = int(first);
        part.count = int(std::min(most, molecules() - first));
        const auto texture = [&](const Buffer& buffer, int count, const char* label) {
            const Range range = rangeOf(part, buffer, count);
            return BufferTexture(context, buffer, label, range.offset, range.bytes);
        };
        for (size_t side = 0; side < (inPlace_ ? 1u : 2u); ++side)
            part.state[side] = texture(state_[side], layout().stateElements(), "state");
        part.record = texture(records_, 1, "records");
        if (constants_) part.constant = texture(constants_, 1, "constants");
        if (steering_) part.steering = texture(steering_, steeringElements, "steering");
        if (normals_) part.normal = texture(normals_, layout().positionElements(), "normals");
        parts_.push_back(std::move(part));
    }
}

void store(const gpu::Program& program, const char* block, const GroupBuffers::Range& range) {
    program.storage(block, *range.buffer, range.offset, range.bytes);
}

void GroupBuffers::bindRead(const gpu::Program& program, size_t index) const {
    const Part& part = parts_[index];
    if (program.uses("oldState")) program.texture("oldState", oldState(part));
    if (program.uses("oldRecords")) program.texture("oldRecords", part.record);
    if (program.uses("constants")) program.texture("constants", part.constant);
    if (program.uses("steering")) program.texture("steering", part.steering);
}

void GroupBuffers::bindNew(const gpu::Program& program, const Part& part) const {
    store(program, "NewState", newState(part));
    if (program.declares("NewRecords")) store(program, "NewRecords", records(part));
    if (program.declares("NewNormals")) store(program, "NewNormals", normals(part));
    if (!program.declares("MatrixNumbers")) return;
    gpu::barrier({gpu::Barrier::storage});  // another part may still work on it
    program.storage("MatrixNumbers", matrixNumbers_);
}

void GroupBuffers::run(const gpu::Program& program, size_t index, Output) const {
    const Part& part = parts_[index];
    bindNew(program, part);
    program.dispatch(workgroups(part));
}

template <typename Self>
auto& GroupBuffers::bufferOf(Self& self, Values values) {
    switch (values) {
    case Values::state:
        return self.state_[size_t(self.current_)];
    case Values::stateBefore:
        EXPECTS(!self.inPlace_);
        return self.state_[size_t(1 - self.current_)];
    case Values::records:
    case Values::recordsBefore:  // there is one side of them
        return self.records_;
    case Values::constants:
        return self.constants_;
    case Values::steering:
        return self.steering_;
    case Values::normals:
        break;
    }
    return self.normals_;
}

void GroupBuffers::upload(Values values, size_t first, const std::vector<glm::vec4>& packed) {
    const auto kind = values == Values::constants ? Traffic::Kind::parameters : Traffic::Kind::state;
    const size_t offset = first * size_t(elements(values)) * sizeof(glm::vec4);
    bufferOf(*this, values).update(kind, offset, packed.data(), packed.size() * sizeof(glm::vec4));
}

std::vector<glm::vec4> GroupBuffers::download(Values values) const {
    const Buffer& buffer = bufferOf(*this, values);
    std::vector<glm::vec4> out(buffer.bytes() / sizeof(glm::vec4));
    buffer.download(Traffic::Kind::state, 0, out.data(), buffer.bytes());
    return out;
}

// Whole blocks cross the bus.
std::vector<glm::vec4> GroupBuffers::download(Values values, size_t first, size_t count) const {
    const int each = elements(values);
    const size_t block = size_t(BufferLayout::block), firstBlock = first / block;
    const size_t blocks = (first + count + block - 1) / block - firstBlock, perBlock = block * size_t(each);
    std::vector<glm::vec4> all(blocks * perBlock), out;
    bufferOf(*this, values)
        .download(Traffic::Kind::state, firstBlock * perBlock * sizeof(glm::vec4), all.data(),
                  all.size() * sizeof(glm::vec4));
    for (size_t m = first; m < first + count; ++m)
        for (int e = 0; e < each; ++e)
            out.push_back(all[BufferLayout::index(m - firstBlock * block, e, each)]);
    return out;
}

}  // namespace shoal
