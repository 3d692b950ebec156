#include "simulate/packed_state.h"

#include <algorithm>
#include <cmath>

#include "compile/pack.h"
#include "core/contract.h"

namespace shoal {

namespace {

// Reads and writes 4-vectors of molecules of which so many lie together.
struct Packer {
    const BufferLayout& layout;
    int elements;  // 4-vectors a molecule
    size_t together;

    size_t at(size_t molecule, int element) const {
        return BufferLayout::index(molecule, element, elements, together);
    }

    // The vertices' floats, from 4-vector `first` on.
    void pack(const std::vector<glm::vec3>& values, int first, std::vector<glm::vec4>& out) const {
        const size_t vertices = size_t(layout.vertexCount);
        for (size_t i = 0; i < values.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const int number = int(i % vertices) * 3 + c;
                out[at(i / vertices, first + number / 4)][number % 4] = values[i][c];
            }
        }
    }

    std::vector<glm::vec3> unpack(const std::vector<glm::vec4>& packed, int first, size_t molecules) const {
        const size_t vertices = size_t(layout.vertexCount);
        std::vector<glm::vec3> values(molecules * vertices);
        for (size_t i = 0; i < values.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const int number = int(i % vertices) * 3 + c;
                values[i][c] = packed[at(i / vertices, first + number / 4)][number % 4];
            }
        }
        return values;
    }

    // A state that another solver or path has left behind has none.
    void packHistory(const GroupState& state, std::vector<glm::vec4>& out) const {
        const int part = layout.positionElements();
        if (!state.displacements.empty()) {
            pack(state.displacements, 2 * part, out);
            pack(state.velocityChanges, 3 * part, out);
            return;
        }
        for (size_t m = 0; m < state.anchors.size(); ++m)
            out[at(m, 2 * part)].x = noHistory;
    }

    // Lanes past the last molecule do what it does, so that they never do anything worse.
    void repeatLast(size_t count, std::vector<glm::vec4>& packed) const {
        for (size_t m = count; m < packed.size() / size_t(elements); ++m)
            for (int e = 0; e < elements; ++e)
                packed[at(m, e)] = packed[at(count - 1, e)];
    }

    float& age(size_t molecule, std::vector<glm::vec4>& packed) const {
        return layout.lifeApart() ? packed[at(molecule, elements - 1)].x
                                  : packed[at(molecule, layout.positionElements() - 1)].w;
    }
    float& span(size_t molecule, std::vector<glm::vec4>& packed) const {
        return layout.lifeApart() ? packed[at(molecule, elements - 1)].y
                                  : packed[at(molecule, 2 * layout.positionElements() - 1)].w;
    }
};

}  // namespace

PackedState::PackedState(const GroupPlan& group, size_t molecules, size_t together)
    : layout_(group.layout()), molecules_(molecules), together_(together), seeds_(group.constants.seeds) {}

int PackedState::elements(Values values) const {
    switch (values) {
    case Values::state:
    case Values::stateBefore:
        return layout_.stateElements();
    case Values::normals:
        return layout_.positionElements();
    case Values::steering:
        return steeringElements;
    case Values::records:
    case Values::recordsBefore:
    case Values::constants:
        break;
    }
    return 1;
}

void PackedState::writeConstants(const GroupPlan& group) {
    std::vector<glm::vec4> constants(molecules_);
    for (size_t m = 0; m < group.constants.scales.size(); ++m)
        constants[m] = glm::vec4(group.constants.scales[m], group.constants.phases[m], 0, 0);
    Packer{layout_, 1, together_}.repeatLast(size_t(group.count), constants);
    upload(Values::constants, constants);
}

void PackedState::write(const GroupPlan& group, const GroupState& state) {
    const size_t count = size_t(group.count);
    const Packer packer{layout_, layout_.stateElements(), together_};
    std::vector<glm::vec4> packed(molecules_ * size_t(packer.elements));
    packer.pack(state.positions, 0, packed);
    packer.pack(state.velocities, layout_.positionElements(), packed);
    if (layout_.history) packer.packHistory(state, packed);
    // lanes past the last place are free places for ever
    for (size_t m = 0; layout_.life && m < state.lives.size(); ++m) {
        packer.age(m, packed) = state.lives[m].x;
        packer.span(m, packed) = state.lives[m].y;
    }
    if (!layout_.life) packer.repeatLast(count, packed);
    upload(Values::state, packed);
    std::vector<glm::vec4> records(molecules_);
    const std::vector<uint32_t>& seeds = state.seeds.empty() ? seeds_ : state.seeds;
    for (size_t m = 0; m < count; ++m) {
        const float label = float(seeds[m] + 1);
        records[m] = glm::vec4(state.anchors[m], state.released[m] ? -label : label);
    }
    Packer{layout_, 1, together_}.repeatLast(count, records);
    upload(Values::records, records);
    if (hasSteering()) {
        // what another plan's state does not have
        std::vector<glm::vec4> steering = unsteered(molecules_);
        std::copy(state.steering.begin(), state.steering.end(), steering.begin());
        const Packer steeringPacker{layout_, steeringElements, together_};
        std::vector<glm::vec4> packedSteering(steering.size());
        for (size_t i = 0; i < steering.size(); ++i)
            packedSteering[steeringPacker.at(i / steeringElements, int(i % steeringElements))] = steering[i];
        upload(Values::steering, packedSteering);
    }
    if (hasConstants() && !state.looks.empty()) {
        std::vector<glm::vec4> looks(molecules_);
        for (size_t m = 0; m < state.looks.size(); ++m)
            looks[m] = glm::vec4(state.looks[m], 0, 0);
        upload(Values::constants, looks);
    }
}

GroupState PackedState::readSide(const GroupPlan& group, bool before) const {
    const size_t count = size_t(group.count);
    std::vector<glm::vec4> packed = download(before ? Values::stateBefore : Values::state);
    const Packer packer{layout_, layout_.stateElements(), together_};
    const int part = layout_.positionElements();
    GroupState state;
    state.positions = packer.unpack(packed, 0, count);
    state.velocities = packer.unpack(packed, part, count);
    if (layout_.history) {
        state.displacements = packer.unpack(packed, 2 * part, count);
        state.velocityChanges = packer.unpack(packed, 3 * part, count);
    }
    const std::vector<glm::vec4> records = download(before ? Values::recordsBefore : Values::records);
    for (size_t m = 0; m < count; ++m) {
        state.anchors.emplace_back(records[m]);
        state.released.push_back(std::signbit(records[m].w));
    }
    if (hasSteering()) {
        const std::vector<glm::vec4> steering = download(Values::steering);
        const Packer steeringPacker{layout_, steeringElements, together_};
        for (size_t i = 0; i < count * steeringElements; ++i)
            state.steering.push_back(
                steering[steeringPacker.at(i / steeringElements, int(i % steeringElements))]);
    }
    if (!layout_.life) return state;
    for (size_t m = 0; m < count; ++m) {
        state.lives.emplace_back(packer.age(m, packed), packer.span(m, packed));
        state.seeds.push_back(records[m].w == 0 ? 0 : uint32_t(std::abs(records[m].w)) - 1);
    }
    const std::vector<glm::vec4> looks =
        hasConstants() ? download(Values::constants) : std::vector<glm::vec4>(count, glm::vec4(1, 0, 0, 0));
    for (size_t m = 0; m < count; ++m)
        state.looks.emplace_back(looks[m].x, looks[m].y);
    return state;
}

GroupState PackedState::readOne(size_t molecule) const {
    std::vector<glm::vec4> packed = download(Values::state, molecule);
    const Packer packer{layout_, layout_.stateElements(), 1};
    const glm::vec4 record = download(Values::records, molecule)[0];
    GroupState out;
    out.positions = packer.unpack(packed, 0, 1);
    out.velocities = packer.unpack(packed, layout_.positionElements(), 1);
    out.anchors.emplace_back(record);
    out.released.push_back(std::signbit(record.w));
    if (layout_.life) out.lives.emplace_back(packer.age(0, packed), packer.span(0, packed));
    out.looks.emplace_back(hasConstants() ? glm::vec2(download(Values::constants, molecule)[0])
                                          : glm::vec2(1, 0));
    return out;
}

std::vector<glm::vec3> PackedState::readNormals(const GroupPlan& group) const {
    return Packer{layout_, layout_.positionElements(), together_}.unpack(download(Values::normals), 0,
                                                                         size_t(group.count));
}

}  // namespace shoal
