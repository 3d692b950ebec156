#include "simulate/texture_state.h"

#include <algorithm>

#include "core/error.h"
#include "gpu/buffer.h"
#include "gpu/program.h"

namespace shoal {

using gpu::Format;
using gpu::Texture;
using gpu::Traffic;

// All groups share a texture: of one that does not fit, the largest group is named.
static Texture makeTexture(gpu::Context& context, const Plan& plan, int rows, const char* label) {
    try {
        return Texture(context, Format::rgba32f, stateWidth, rows, label);
    } catch (const gpu::OutOfMemory& error) {
        const auto rowsOf = [](const GroupPlan& group) { return group.texture.rows; };
        const GroupPlan& largest = *std::ranges::max_element(plan.groups, {}, rowsOf);
        throw gpu::OutOfMemory(
            largest.location,
            concat(error.message(), ", for ", many(largest.count, "molecule", "molecules"), " here",
                   plan.groups.size() > 1 ? " and those of the other groups" : ""));
    }
}

static TwoSided makeSides(gpu::Context& context, const Plan& plan, int rows, const char* label) {
    TwoSided sides;
    for (Texture& texture : sides.side)
        texture = makeTexture(context, plan, rows, label);
    sides.now.assign(plan.groups.size(), 0);
    return sides;
}

void setGroup(const gpu::Program& program, const GroupPlan& group) {
    program.set("firstRow", group.texture.firstRow);
    program.set("slabRows", group.texture.slabRows);
    program.set("moleculeCount", group.count);
    program.set("vertexCount", group.vertexCount);
    program.set("firstRecordRow", group.texture.firstRecordRow);
    program.set("topologyBase", group.topologyBase);
}

TextureState::TextureState(gpu::Context& context, const Plan& plan) : targets_(context) {
    const auto any = [&](bool Needs::*need) {
        return std::any_of(plan.groups.begin(), plan.groups.end(),
                           [&](const GroupPlan& group) { return group.needs.*need; });
    };
    position = makeSides(context, plan, plan.rows, "positions");
    velocity = makeSides(context, plan, plan.rows, "velocities");
    if (any(&Needs::acceleration)) acceleration = makeSides(context, plan, plan.rows, "accelerations");
    const bool stages = std::any_of(plan.groups.begin(), plan.groups.end(),
                                    [](const GroupPlan& group) { return solver(group.solver).rungeKutta(); });
    for (auto* pair : {&stagePosition, &stageVelocity, &sumVelocity, &sumAcceleration})
        for (Texture& texture : *pair)
            if (stages) texture = makeTexture(context, plan, plan.rows, "stages");
    record = makeSides(context, plan, plan.recordRows, "records");
    if (any(&Needs::normals)) normal = makeTexture(context, plan, plan.rows, "normals");
    constant = makeTexture(context, plan, plan.recordRows, "constants");
    for (const GroupPlan& group : plan.groups) {
        std::vector<glm::vec4> texels(size_t(group.texture.slabRows) * stateWidth);
        const GroupConstants& c = group.constants;
        for (size_t m = 0; m < c.seeds.size(); ++m)
            texels[m] = glm::vec4(float(c.seeds[m]), c.scales[m], c.phases[m], 0);
        constant.upload(Traffic::Kind::parameters, 0, group.texture.firstRecordRow, stateWidth,
                        group.texture.slabRows, texels.data(), texels.size() * sizeof(glm::vec4));
    }
}

static void uploadRows(Texture& texture, int firstRow, int rows, const std::vector<glm::vec4>& texels) {
    texture.upload(Traffic::Kind::state, 0, firstRow, stateWidth, rows, texels.data(),
                   texels.size() * sizeof(glm::vec4));
}

static std::vector<glm::vec4> downloadRows(const Texture& texture, int firstRow, int rows) {
    std::vector<glm::vec4> texels(size_t(rows) * stateWidth);
    texture.download(Traffic::Kind::state, 0, firstRow, stateWidth, rows, texels.data(),
                     texels.size() * sizeof(glm::vec4));
    return texels;
}

// Returns the texel of vertex v of molecule m, within the group's rows.
static size_t texelOf(const GroupPlan& group, size_t m, size_t v) {
    return (v * size_t(group.texture.slabRows) + m / stateWidth) * stateWidth + m % stateWidth;
}

// From index = molecule * vertexCount + vertex to the group's rows, and back.
static std::vector<glm::vec4> asTexels(const GroupPlan& group, const std::vector<glm::vec3>& values) {
    std::vector<glm::vec4> texels(size_t(group.texture.rows) * stateWidth);
    const size_t vertices = size_t(group.vertexCount);
    for (size_t i = 0; i < values.size(); ++i)
        texels[texelOf(group, i / vertices, i % vertices)] = glm::vec4(values[i], 0);
    return texels;
}

static std::vector<glm::vec3> asVertices(const GroupPlan& group, const std::vector<glm::vec4>& texels) {
    std::vector<glm::vec3> values;
    const size_t vertices = size_t(group.vertexCount);
    values.reserve(size_t(group.count) * vertices);
    for (size_t m = 0; m < size_t(group.count); ++m)
        for (size_t v = 0; v < vertices; ++v)
            values.emplace_back(texels[texelOf(group, m, v)]);
    return values;
}

void TextureState::write(const GroupPlan& group, size_t index, const GroupState& state) {
    const TextureLayout& at = group.texture;
    uploadRows(position.current(index), at.firstRow, at.rows, asTexels(group, state.positions));
    uploadRows(velocity.current(index), at.firstRow, at.rows, asTexels(group, state.velocities));
    std::vector<glm::vec4> records(size_t(at.slabRows) * stateWidth);
    for (size_t m = 0; m < state.anchors.size(); ++m)
        records[m] = glm::vec4(state.anchors[m], float(state.released[m]));
    uploadRows(record.current(index), at.firstRecordRow, at.slabRows, records);
}

GroupState TextureState::read(const GroupPlan& group, size_t index) const {
    const TextureLayout& at = group.texture;
    GroupState state;
    state.positions = asVertices(group, downloadRows(position.read(index), at.firstRow, at.rows));
    state.velocities = asVertices(group, downloadRows(velocity.read(index), at.firstRow, at.rows));
    const auto records = downloadRows(record.read(index), at.firstRecordRow, at.slabRows);
    for (size_t m = 0; m < size_t(group.count); ++m) {
        state.anchors.emplace_back(records[m]);
        state.released.push_back(records[m].w > 0.5f);
    }
    return state;
}

GroupState TextureState::readOne(const GroupPlan& group, size_t index, size_t molecule) const {
    const auto texel = [&](const Texture& texture, int firstRow, size_t slab) {
        glm::vec4 out(0);
        const size_t row = size_t(firstRow) + slab * size_t(group.texture.slabRows) + molecule / stateWidth;
        texture.download(Traffic::Kind::state, int(molecule % stateWidth), int(row), 1, 1, &out, sizeof out);
        return out;
    };
    GroupState state;
    for (size_t v = 0; v < size_t(group.vertexCount); ++v) {
        state.positions.emplace_back(texel(position.read(index), group.texture.firstRow, v));
        state.velocities.emplace_back(texel(velocity.read(index), group.texture.firstRow, v));
    }
    const glm::vec4 own = texel(record.read(index), group.texture.firstRecordRow, 0);
    state.anchors.emplace_back(own);
    state.released.push_back(own.w > 0.5f);
    const glm::vec4 look = texel(constant, group.texture.firstRecordRow, 0);
    state.looks.emplace_back(look.y, look.z);
    return state;
}

std::vector<glm::vec3> TextureState::readNormals(const GroupPlan& group) const {
    return asVertices(group, downloadRows(normal, group.texture.firstRow, group.texture.rows));
}

}  // namespace shoal
