#include "simulate/texture_state.h"

#include <algorithm>

#include "compile/passes.h"
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
        const auto vertices = [](const GroupPlan& group) { return group.count * group.vertexCount; };
        const GroupPlan& largest = *std::ranges::max_element(plan.groups, {}, vertices);
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
    sides.currentSide.assign(plan.groups.size(), 0);
    return sides;
}

void TextureState::setGroup(const gpu::Program& program, size_t group) const {
    program.set("firstRow", rows_[group].firstRow);
    program.set("slabRows", rows_[group].slabRows);
    program.set("moleculeCount", plan_->groups[group].count);
    program.set("vertexCount", plan_->groups[group].vertexCount);
    program.set("firstRecordRow", rows_[group].firstRecordRow);
    program.set("topologyBase", plan_->groups[group].topologyBase);
}

static void uploadRows(Texture& texture, int firstRow, const std::vector<glm::vec4>& texels,
                       Traffic::Kind kind = Traffic::Kind::state) {
    texture.upload(kind, 0, firstRow, stateWidth, stateRows(texels.size()), texels.data(),
                   texels.size() * sizeof(glm::vec4));
}

TextureState::TextureState(gpu::Context& context, const Plan& plan) : plan_(&plan), targets_(context) {
    int rows = 0, recordRows = 0;
    for (const GroupPlan& group : plan.groups) {
        const int slab = stateRows(size_t(group.count));
        rows_.push_back({slab, rows, group.vertexCount * slab, recordRows});
        rows += rows_.back().rows;
        recordRows += slab;
    }
    const auto any = [&](bool Needs::*need) {
        return std::any_of(plan.groups.begin(), plan.groups.end(),
                           [&](const GroupPlan& group) { return group.needs.*need; });
    };
    position = makeSides(context, plan, rows, "positions");
    velocity = makeSides(context, plan, rows, "velocities");
    if (std::ranges::any_of(plan.groups, keepsAcceleration))
        acceleration = makeSides(context, plan, rows, "accelerations");
    const bool stages = std::any_of(plan.groups.begin(), plan.groups.end(),
                                    [](const GroupPlan& group) { return solver(group.solver).rungeKutta(); });
    for (auto* pair : {&stagePosition, &stageVelocity, &sumVelocity, &sumAcceleration})
        for (Texture& texture : *pair)
            if (stages) texture = makeTexture(context, plan, rows, "stages");
    record = makeSides(context, plan, recordRows, "records");
    if (any(&Needs::normals)) normal = makeTexture(context, plan, rows, "normals");
    constant = makeTexture(context, plan, recordRows, "constants");
    for (size_t g = 0; g < rows_.size(); ++g) {
        std::vector<glm::vec4> texels(size_t(rows_[g].slabRows) * stateWidth);
        const GroupConstants& c = plan.groups[g].constants;
        for (size_t m = 0; m < c.seeds.size(); ++m)
            texels[m] = glm::vec4(float(c.seeds[m]), c.scales[m], c.phases[m], 0);
        uploadRows(constant, rows_[g].firstRecordRow, texels, Traffic::Kind::parameters);
    }
}

static std::vector<glm::vec4> downloadRows(const Texture& texture, int firstRow, int rows) {
    std::vector<glm::vec4> texels(size_t(rows) * stateWidth);
    texture.download(Traffic::Kind::state, 0, firstRow, stateWidth, rows, texels.data(),
                     texels.size() * sizeof(glm::vec4));
    return texels;
}

// Returns the texel of vertex v of molecule m, within the group's rows.
static size_t texelOf(const TextureState::Rows& group, size_t m, size_t v) {
    return (v * size_t(group.slabRows) + m / stateWidth) * stateWidth + m % stateWidth;
}

void TextureState::upload(Texture& texture, size_t group, const std::vector<glm::vec3>& values) const {
    const Rows& rows = rows_[group];
    const size_t vertices = size_t(plan_->groups[group].vertexCount);
    std::vector<glm::vec4> texels(size_t(rows.rows) * stateWidth);
    for (size_t i = 0; i < values.size(); ++i)
        texels[texelOf(rows, i / vertices, i % vertices)] = glm::vec4(values[i], 0);
    uploadRows(texture, rows.firstRow, texels);
}

std::vector<glm::vec3> TextureState::download(const Texture& texture, size_t group) const {
    const Rows& rows = rows_[group];
    const std::vector<glm::vec4> texels = downloadRows(texture, rows.firstRow, rows.rows);
    const size_t vertices = size_t(plan_->groups[group].vertexCount);
    std::vector<glm::vec3> values(size_t(plan_->groups[group].count) * vertices);
    for (size_t i = 0; i < values.size(); ++i)
        values[i] = texels[texelOf(rows, i / vertices, i % vertices)];
    return values;
}

void TextureState::write(size_t group, const GroupState& state) {
    upload(position.current(group), group, state.positions);
    upload(velocity.current(group), group, state.velocities);
    std::vector<glm::vec4> records(size_t(rows_[group].slabRows) * stateWidth);
    for (size_t m = 0; m < state.anchors.size(); ++m)
        records[m] = glm::vec4(state.anchors[m], float(state.released[m]));
    uploadRows(record.current(group), rows_[group].firstRecordRow, records);
}

GroupState TextureState::read(size_t group) const {
    GroupState state;
    state.positions = download(position.read(group), group);
    state.velocities = download(velocity.read(group), group);
    const auto records = downloadRows(record.read(group), rows_[group].firstRecordRow, rows_[group].slabRows);
    for (size_t m = 0; m < size_t(plan_->groups[group].count); ++m) {
        state.anchors.emplace_back(records[m]);
        state.released.push_back(records[m].w > 0.5f);
    }
    return state;
}

GroupState TextureState::readSome(size_t group, size_t first, size_t count) const {
    const Rows& rows = rows_[group];
    const size_t vertices = size_t(plan_->groups[group].vertexCount);
    // put(m, texel) for each of the molecules, the first of which is 0
    const auto read = [&](const Texture& texture, int firstRow, size_t slab, const auto& put) {
        for (const TexelRun& run : texelRuns(first, count)) {
            std::vector<glm::vec4> texels(size_t(run.width));
            texture.download(Traffic::Kind::state, run.x, firstRow + int(slab) * rows.slabRows + run.y,
                             run.width, 1, texels.data(), texels.size() * sizeof(glm::vec4));
            for (size_t i = 0; i < texels.size(); ++i)
                put(run.offset + i, texels[i]);
        }
    };
    GroupState state;
    state.positions.resize(count * vertices);
    state.velocities.resize(count * vertices);
    for (size_t v = 0; v < vertices; ++v) {
        read(position.read(group), rows.firstRow, v,
             [&](size_t m, const glm::vec4& texel) { state.positions[m * vertices + v] = texel; });
        read(velocity.read(group), rows.firstRow, v,
             [&](size_t m, const glm::vec4& texel) { state.velocities[m * vertices + v] = texel; });
    }
    read(record.read(group), rows.firstRecordRow, 0, [&](size_t, const glm::vec4& texel) {
        state.anchors.emplace_back(texel);
        state.released.push_back(texel.w > 0.5f);
    });
    read(constant, rows.firstRecordRow, 0,
         [&](size_t, const glm::vec4& texel) { state.looks.emplace_back(texel.y, texel.z); });
    return state;
}

}  // namespace shoal
