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
    // Writing: how many molecules there are from `offset` on, with which the packed ones start.
    size_t offset = 0, count = 0;

    size_t index(size_t molecule, int element) const {
        return BufferLayout::index(molecule, element, elements, together);
    }

    // The vertices' floats, from 4-vector `firstElement` on.
    void pack(const std::vector<glm::vec3>& values, int firstElement, std::vector<glm::vec4>& out) const {
        const size_t vertices = size_t(layout.vertexCount);
        for (size_t i = 0; i < count * vertices; ++i) {
            for (int c = 0; c < 3; ++c) {
                const int number = int(i % vertices) * 3 + c;
                out[index(i / vertices, firstElement + number / 4)][number % 4] =
                    values[offset * vertices + i][c];
            }
        }
    }

    std::vector<glm::vec3> unpack(const std::vector<glm::vec4>& packed, int first, size_t molecules) const {
        const size_t vertices = size_t(layout.vertexCount);
        std::vector<glm::vec3> values(molecules * vertices);
        for (size_t i = 0; i < values.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const int number = int(i % vertices) * 3 + c;
                values[i][c] = packed[index(i / vertices, first + number / 4)][number % 4];
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
        for (size_t m = 0; m < count; ++m)
            out[index(m, 2 * part)].x = noHistory;
    }

    // Lanes past the last molecule do what it does, so that they never do anything worse.
    void repeatLast(std::vector<glm::vec4>& packed) const {
        for (size_t m = count; m < packed.size() / size_t(elements); ++m)
            for (int e = 0; e < elements; ++e)
                packed[index(m, e)] = packed[index(count - 1, e)];
    }

    float& age(size_t molecule, std::vector<glm::vec4>& packed) const {
        return layout.lifeApart() ? packed[index(molecule, elements - 1)].x
                                  : packed[index(molecule, layout.positionElements() - 1)].w;
    }
    float& span(size_t molecule, std::vector<glm::vec4>& packed) const {
        return layout.lifeApart() ? packed[index(molecule, elements - 1)].y
                                  : packed[index(molecule, 2 * layout.positionElements() - 1)].w;
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

// Calls fill(packer, packed) for one piece of the molecules after the other, and uploads what it has packed:
// a start of many takes little memory beside itself.
template <typename Fill>
void PackedState::uploadPieces(Values values, size_t count, Fill fill) {
    constexpr size_t piece = size_t(1) << 18;  // whole rows and blocks, so that the last one holds a molecule
    for (size_t first = 0; first < molecules_; first += piece) {
        const size_t here = std::min(piece, molecules_ - first);
        const Packer packer{layout_, elements(values), std::min(together_, here), first,
                            std::min(here, count - first)};
        std::vector<glm::vec4> packed(here * size_t(packer.elements));
        fill(packer, packed);
        upload(values, first, packed);
    }
}

void PackedState::writeConstants(const GroupPlan& group) {
    uploadPieces(Values::constants, size_t(group.count), [&](const Packer& packer, auto& packed) {
        for (size_t m = 0; m < packer.count; ++m)
            packed[m] = glm::vec4(group.constants.scales[packer.offset + m],
                                  group.constants.phases[packer.offset + m], 0, 0);
        packer.repeatLast(packed);
    });
}

void PackedState::writeMotion(size_t count, const GroupState& state) {
    uploadPieces(Values::state, count, [&](const Packer& packer, auto& packed) {
        packer.pack(state.positions, 0, packed);
        packer.pack(state.velocities, layout_.positionElements(), packed);
        if (layout_.history) packer.packHistory(state, packed);
        // lanes past the last place are free places for ever
        for (size_t m = 0; layout_.life && m < packer.count; ++m) {
            packer.age(m, packed) = state.lives[packer.offset + m].x;
            packer.span(m, packed) = state.lives[packer.offset + m].y;
        }
        if (!layout_.life) packer.repeatLast(packed);
    });
}

void PackedState::writeRecords(size_t count, const GroupState& state) {
    const std::vector<uint32_t>& seeds = state.seeds.empty() ? seeds_ : state.seeds;
    uploadPieces(Values::records, count, [&](const Packer& packer, auto& packed) {
        for (size_t m = 0; m < packer.count; ++m) {
            const size_t own = packer.offset + m;
            const float label = float(seeds[own] + 1);
            packed[m] = glm::vec4(state.anchors[own], state.released[own] ? -label : label);
        }
        packer.repeatLast(packed);
    });
}

void PackedState::write(const GroupPlan& group, const GroupState& state) {
    const size_t count = size_t(group.count);
    writeMotion(count, state);
    writeRecords(count, state);
    if (hasSteering())
        uploadPieces(Values::steering, count, [&](const Packer& packer, auto& packed) {
            // what another plan's state does not have
            const std::vector<glm::vec4> none = unsteered(1);
            for (size_t m = 0; m < packed.size() / steeringElements; ++m)
                for (size_t e = 0; e < steeringElements; ++e) {
                    const size_t own = (packer.offset + m) * steeringElements + e;
                    packed[packer.index(m, int(e))] =
                        own < state.steering.size() ? state.steering[own] : none[e];
                }
        });
    if (hasConstants() && !state.looks.empty())
        uploadPieces(Values::constants, count, [&](const Packer& packer, auto& packed) {
            for (size_t m = 0; m < packer.count; ++m)
                packed[m] = glm::vec4(state.looks[packer.offset + m], 0, 0);
        });
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
                steering[steeringPacker.index(i / steeringElements, int(i % steeringElements))]);
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

GroupState PackedState::readSome(size_t first, size_t count) const {
    std::vector<glm::vec4> packed = download(Values::state, first, count);
    const Packer packer{layout_, layout_.stateElements(), 1};
    GroupState out;
    out.positions = packer.unpack(packed, 0, count);
    out.velocities = packer.unpack(packed, layout_.positionElements(), count);
    for (const glm::vec4& record : download(Values::records, first, count)) {
        out.anchors.emplace_back(record);
        out.released.push_back(std::signbit(record.w));
        if (layout_.life) out.seeds.push_back(record.w == 0 ? 0 : uint32_t(std::abs(record.w)) - 1);
    }
    for (size_t m = 0; layout_.life && m < count; ++m)
        out.lives.emplace_back(packer.age(m, packed), packer.span(m, packed));
    out.looks.assign(count, glm::vec2(1, 0));
    if (hasConstants()) {
        const std::vector<glm::vec4> looks = download(Values::constants, first, count);
        std::copy(looks.begin(), looks.end(), out.looks.begin());
    }
    return out;
}

std::vector<glm::vec3> PackedState::readNormals(const GroupPlan& group) const {
    return Packer{layout_, layout_.positionElements(), together_}.unpack(download(Values::normals), 0,
                                                                         size_t(group.count));
}

}  // namespace shoal
