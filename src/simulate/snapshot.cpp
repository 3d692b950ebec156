// Reading the state back: for exports, tests and hashes, never in a plain frame.
#include <bit>
#include <cstring>

#include "simulate/simulation.h"

namespace shoal {

using gpu::Texture;
using gpu::Traffic;

static std::vector<glm::vec4> readRows(const Texture& texture, int firstRow, int rows) {
    std::vector<glm::vec4> texels(size_t(rows) * stateWidth);
    texture.download(Traffic::Kind::state, 0, firstRow, stateWidth, rows, texels.data(),
                     texels.size() * sizeof(glm::vec4));
    return texels;
}

Snapshot Simulation::snapshot(size_t index) {
    const GroupPlan& group = plan_.groups[index];
    const auto positions = readRows(state_.position.read(index), group.firstRow, group.rows);
    const auto velocities = readRows(state_.velocity.read(index), group.firstRow, group.rows);
    const auto records = readRows(state_.record.read(index), group.firstRecordRow, group.slabRows);
    std::vector<glm::vec4> normals;
    if (state_.normal && group.needs.normals) normals = readRows(state_.normal, group.firstRow, group.rows);

    Snapshot out;
    out.time = time_;
    out.count = group.count;
    out.vertexCount = group.vertexCount;
    const size_t total = size_t(group.count) * size_t(group.vertexCount);
    out.positions.reserve(total);
    out.velocities.reserve(total);
    out.normals.reserve(total);
    for (int m = 0; m < group.count; ++m) {
        const size_t column = size_t(m % stateWidth), slabRow = size_t(m / stateWidth);
        const glm::vec4 record = records[slabRow * stateWidth + column];
        out.released.push_back(record.w > 0.5f);
        for (int v = 0; v < group.vertexCount; ++v) {
            const size_t texel = (size_t(v) * size_t(group.slabRows) + slabRow) * stateWidth + column;
            out.positions.push_back(glm::dvec3(record) + glm::dvec3(positions[texel]));
            out.velocities.push_back(glm::dvec3(velocities[texel]));
            out.normals.push_back(normals.empty() ? glm::vec3(0) : glm::vec3(normals[texel]));
        }
    }
    return out;
}

// FNV-1a over the bits of positions, velocities and records of the molecules that exist.
uint64_t Simulation::hash() {
    uint64_t hash = 14695981039346656037ull;
    const auto add = [&](const glm::vec4& texel) {
        for (int i = 0; i < 4; ++i)
            hash = (hash ^ std::bit_cast<uint32_t>(texel[i])) * 1099511628211ull;
    };
    for (size_t g = 0; g < plan_.groups.size(); ++g) {
        const GroupPlan& group = plan_.groups[g];
        const auto addMolecules = [&](const std::vector<glm::vec4>& texels, int slabs) {
            for (int slab = 0; slab < slabs; ++slab)
                for (int m = 0; m < group.count; ++m)
                    add(texels[size_t(slab) * size_t(group.slabRows) * stateWidth + size_t(m)]);
        };
        addMolecules(readRows(state_.position.read(g), group.firstRow, group.rows), group.vertexCount);
        addMolecules(readRows(state_.velocity.read(g), group.firstRow, group.rows), group.vertexCount);
        addMolecules(readRows(state_.record.read(g), group.firstRecordRow, group.slabRows), 1);
    }
    return hash;
}

}  // namespace shoal
