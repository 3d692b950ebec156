#include "simulate/layer_state.h"

#include <algorithm>
#include <span>

#include "core/error.h"
#include "gpu/buffer.h"
#include "simulate/fused_kernel.h"

namespace shoal {

using gpu::Framebuffer;
using gpu::Texture;
using gpu::Traffic;

namespace {

size_t paddedToRows(int count) {
    return (size_t(count) + stateWidth - 1) / stateWidth * stateWidth;
}

std::vector<LayerDraw> drawsInto(gpu::Context& context, const std::vector<gpu::ColorTarget>& all, int targets,
                                 const char* label) {
    std::vector<LayerDraw> out;
    for (const int first : drawsOf(all.size(), targets)) {
        const auto begin = all.begin() + first;
        out.push_back(
            {first, Framebuffer(context, {begin, std::min(begin + targets, all.end())}, nullptr, label)});
    }
    return out;
}

void addLayers(const Texture& texture, std::vector<gpu::ColorTarget>& out) {
    for (int layer = 0; layer < texture.layers(); ++layer)
        out.emplace_back(&texture, layer);
}

}  // namespace

GroupLayers::GroupLayers(gpu::Context& context, const GroupPlan& group, bool normals, int targets)
    : PackedState(group, paddedToRows(group.count), paddedToRows(group.count)), count_(group.count) {
    const auto make = [&](Values values, const char* what) {
        try {
            return Texture(context, gpu::Format::rgba32f, stateWidth, int(molecules() / stateWidth),
                           concat(what, " of ", group.name).c_str(), elements(values));
        } catch (const gpu::OutOfMemory& error) {
            throw gpu::OutOfMemory(group.location, concat(error.message(), ", for ",
                                                          many(group.count, "molecule", "molecules")));
        }
    };
    for (Texture& side : state_)
        side = make(Values::state, "state");
    records_[0] = make(Values::records, "records");
    if (group.needs.records) records_[1] = make(Values::records, "records");
    if (group.needs.scale || group.needs.phase) {
        constants_ = make(Values::constants, "constants");
        writeConstants(group);
    }
    for (size_t side = 0; side < 2 && group.needs.steers; ++side)
        steering_[side] = make(Values::steering, "steering");
    for (size_t side = 0; side < 2 && group.needs.steers; ++side) {
        newSteering_[side] = Framebuffer(context, {{&steering_[1 - side]}}, nullptr, "steering");
    }
    for (size_t side = 0; side < 2; ++side) {
        std::vector<gpu::ColorTarget> all;
        addLayers(state_[1 - side], all);
        if (records_[1]) addLayers(records_[1 - side], all);
        newState_[side] = drawsInto(context, all, targets, "new state");
        if (!group.needs.life) continue;
        all.clear();
        addLayers(state_[side], all);
        addLayers(records_[side], all);
        if (constants_) addLayers(constants_, all);
        newborns_[side] = drawsInto(context, all, targets, "newborns");
    }
    if (!normals || !group.needs.normals) return;
    normals_ = make(Values::normals, "normals");
    std::vector<gpu::ColorTarget> all;
    addLayers(normals_, all);
    newNormals_ = drawsInto(context, all, targets, "normals");
}

void GroupLayers::bindRead(const gpu::Program& program, size_t) const {
    if (program.uses("oldState")) program.texture("oldState", state());
    if (program.uses("oldRecords")) program.texture("oldRecords", records());
    if (program.uses("constants")) program.texture("constants", constants_);
    if (program.uses("steering")) program.texture("steering", steering());
}

void GroupLayers::draw(const gpu::Program& program, Output output, int molecules, int vertices) const {
    if (molecules == 0) return;
    const std::vector<LayerDraw>& all = output == Output::normals ? newNormals_ : newState_[size_t(current_)];
    for (const LayerDraw& draw : std::span(all).first(output == Output::nothing ? 1 : all.size())) {
        if (program.uses("firstStored")) program.set("firstStored", draw.first);
        draw.target.bind(0, 0, std::min(stateWidth, molecules), (molecules + stateWidth - 1) / stateWidth);
        gpu::drawVertices(vertices);
    }
}

template <typename Self>
auto& GroupLayers::textureOf(Self& self, Values values) {
    const size_t side = size_t(self.current_);
    switch (values) {
    case Values::state:
        return self.state_[side];
    case Values::stateBefore:
        return self.state_[1 - side];
    case Values::records:
        return self.records_[self.records_[1] ? side : 0];
    case Values::recordsBefore:
        return self.records_[self.records_[1] ? 1 - side : 0];
    case Values::constants:
        return self.constants_;
    case Values::steering:
        return self.steering_[size_t(self.steeringNow_)];
    case Values::normals:
        break;
    }
    return self.normals_;
}

void GroupLayers::upload(Values values, size_t first, const std::vector<glm::vec4>& packed) {
    const auto kind = values == Values::constants ? Traffic::Kind::parameters : Traffic::Kind::state;
    Texture& texture = textureOf(*this, values);
    const size_t here = packed.size() / size_t(texture.layers());
    for (int layer = 0; layer < texture.layers(); ++layer)
        texture.upload(kind, 0, int(first / stateWidth), texture.width(), int(here / stateWidth),
                       &packed[size_t(layer) * here], here * sizeof(glm::vec4), layer);
}

std::vector<glm::vec4> GroupLayers::download(Values values) const {
    const Texture& texture = textureOf(*this, values);
    std::vector<glm::vec4> out(molecules() * size_t(texture.layers()));
    for (int layer = 0; layer < texture.layers(); ++layer)
        texture.download(Traffic::Kind::state, 0, 0, texture.width(), texture.height(),
                         &out[size_t(layer) * molecules()], molecules() * sizeof(glm::vec4), layer);
    return out;
}

std::vector<glm::vec4> GroupLayers::download(Values values, size_t first, size_t count) const {
    const Texture& texture = textureOf(*this, values);
    const size_t layers = size_t(texture.layers());
    std::vector<glm::vec4> out(count * layers), texels;
    for (const TexelRun& run : texelRuns(first, count)) {
        texels.resize(size_t(run.width));
        for (size_t layer = 0; layer < layers; ++layer) {
            texture.download(Traffic::Kind::state, run.x, run.y, run.width, 1, texels.data(),
                             texels.size() * sizeof(glm::vec4), int(layer));
            for (size_t i = 0; i < texels.size(); ++i)
                out[(run.offset + i) * layers + layer] = texels[i];
        }
    }
    return out;
}

}  // namespace shoal
