#include "simulate/state.h"

#include <algorithm>

namespace shoal {

using gpu::Format;
using gpu::Framebuffer;
using gpu::Texture;
using gpu::Traffic;

static TwoSided makeSides(gpu::Context& context, size_t groups, int rows, const char* label) {
    TwoSided sides;
    for (Texture& texture : sides.side)
        texture = Texture(context, Format::rgba32f, stateWidth, rows, label);
    sides.current.assign(groups, 0);
    return sides;
}

static Texture makeTable(gpu::Context& context, const std::vector<glm::vec4>& table, int rows,
                         const char* label) {
    Texture texture(context, Format::rgba32f, stateWidth, rows, label);
    texture.upload(Traffic::Kind::parameters, 0, 0, stateWidth, rows, table.data(),
                   table.size() * sizeof(glm::vec4));
    return texture;
}

State::State(gpu::Context& context, const Plan& plan) : context_(&context) {
    const auto any = [&](bool Needs::*need) {
        return std::any_of(plan.groups.begin(), plan.groups.end(),
                           [&](const GroupPlan& group) { return group.needs.*need; });
    };
    const size_t groups = plan.groups.size();
    position = makeSides(context, groups, plan.rows, "positions");
    velocity = makeSides(context, groups, plan.rows, "velocities");
    if (any(&Needs::acceleration)) acceleration = makeSides(context, groups, plan.rows, "accelerations");
    record = makeSides(context, groups, plan.recordRows, "records");
    if (any(&Needs::normals)) normal = Texture(context, Format::rgba32f, stateWidth, plan.rows, "normals");
    constant = makeTable(context, plan.constants, plan.recordRows, "constants");
    topology = makeTable(context, plan.topology, plan.topologyRows, "topology");
    samples = makeTable(context, plan.samples, plan.sampleRows, "samples");
    upload(plan);
}

void State::upload(const Plan& plan) {
    const auto fill = [](TwoSided& sides, const std::vector<glm::vec4>& texels, int rows) {
        std::fill(sides.current.begin(), sides.current.end(), 0);
        sides.side[0].upload(Traffic::Kind::state, 0, 0, stateWidth, rows, texels.data(),
                             texels.size() * sizeof(glm::vec4));
    };
    fill(position, plan.positions, plan.rows);
    fill(velocity, plan.velocities, plan.rows);
    fill(record, plan.records, plan.recordRows);
}

const Framebuffer& State::target(const Texture& first, const Texture* second) {
    const GLuint a = first.id(), b = second ? second->id() : 0;
    for (const Target& target : targets_)
        if (target.first == a && target.second == b) return target.framebuffer;
    std::vector<const Texture*> colors{&first};
    if (second) colors.push_back(second);
    targets_.push_back({a, b, Framebuffer(*context_, colors, nullptr, first.label().c_str())});
    return targets_.back().framebuffer;
}

}  // namespace shoal
