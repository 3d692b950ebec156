#include "render/water_beams.h"

#include <algorithm>

namespace shoal {

constexpr int smaller = 4;                // than the picture, along a side
constexpr double longest = 60;            // m
constexpr double leastExtinction = 0.02;  // 1/m: what is clearer sends beams no further than this

WaterBeams::WaterBeams(gpu::Context& context, const std::string& shaderRoot, const WaterLight* water)
    : context_(&context), water_(water != nullptr && water->water().rays > 0 ? water : nullptr) {
    if (!water_) return;
    program_ = gpu::Program(context, shaderRoot, {"render/screen.vert", "water/rays.frag", {}, {}, "beams"});
    empty_ = gpu::VertexArray(context, "no corners");
}

void WaterBeams::resize(int width, int height) {
    if (!water_) return;
    light_ = gpu::Texture(*context_, gpu::Format::rgba16f, std::max(1, width / smaller),
                          std::max(1, height / smaller), "beams");
    light_.setLinear();
    target_ = gpu::Framebuffer(*context_, {&light_}, nullptr, "beams");
}

void WaterBeams::draw(const Eye& eye, const Lighting& lighting, const gpu::Texture& sceneDepth) const {
    target_.bind();
    program_.use();
    lighting.applyBeams(program_, eye);
    program_.texture("sceneDepth", unit::sceneDepth, sceneDepth);
    program_.set("viewToScene", eye.viewToScene);
    program_.set("tangents", eye.tangents);
    program_.set("nearest", eye.nearest);
    program_.set("strength", float(water_->water().rays));
    const glm::dvec3 k = glm::max(water_->water().extinction, glm::dvec3(leastExtinction));
    program_.set("reach", float(std::min(longest, 1.5 / std::min({k.x, k.y, k.z}))));
    empty_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace shoal
