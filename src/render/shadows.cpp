#include "render/shadows.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gl.h"

namespace shoal {

glm::dvec3 towardsSun(const Light& light) {
    const double length = glm::length(light.direction);
    return length > 0 ? -light.direction / length : glm::dvec3(0, 1, 0);
}

// The sun is not a point, but half a degree wide: an edge as far away as the map reaches is blurred by 4
// thousandths of that, one a few metres up by centimetres.
static double blurOf(double reach, double texel) {
    return std::clamp(std::min(0.004 * reach, 0.02), 2 * texel, 5 * texel);
}

ShadowMap::ShadowMap(int most, const Box& casters, const glm::dvec3& towardsSun)
    : origin_(0.5 * (casters.low + casters.high)) {
    const glm::dvec3 side = std::abs(towardsSun.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(side, towardsSun));
    const glm::dvec3 above = glm::cross(towardsSun, right);
    const glm::dmat3 toScene(right, above, towardsSun), toLight = glm::transpose(toScene);
    toScene_ = glm::mat3(toScene);

    // The box seen from the sun, and some air around it for what the wind carries off.
    glm::dvec3 half(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        half =
            glm::max(half, glm::abs(toLight * (glm::mix(casters.low, casters.high, high) - origin_.exact)));
    }
    const double reach = 1.15 * std::max({half.x, half.y, 1e-3}), depth = 1.15 * std::max(half.z, 1e-3);
    toClip_ = glm::mat4(glm::ortho(-reach, reach, -reach, reach, -depth, depth) * glm::dmat4(toLight));

    // The 16 texels of render/light.glsl blur by a standard deviation of 0.91 of them, a disc by half its
    // radius.
    const double blur = blurOf(reach, 2 * reach / most);
    size_ = std::min(most, int(std::lround(2 * reach * 0.91 / (0.5 * blur))));
    pixelsPerMeter_ = float(size_ / (2 * reach));
    blur_ = float(blur);
}

bool ShadowMap::covers(const Box& box) const {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        const glm::dvec4 place(glm::mix(box.low, box.high, high) - origin_.exact, 1);
        const glm::dvec4 clip = glm::dmat4(toClip_) * place;
        if (!(std::max(std::abs(clip.x), std::abs(clip.y)) <= 1)) return false;
    }
    return true;
}

glm::dmat4 ShadowMap::toTexels(const Origin& eye, const glm::ivec2& first) const {
    const glm::dmat4 fromEye = glm::translate(glm::dmat4(1), eye.exact - origin_.exact);
    const glm::dvec3 half(0.5 * size_, 0.5 * size_, 0.5);
    const glm::dmat4 toTexels = glm::scale(glm::translate(glm::dmat4(1), half + glm::dvec3(first, 0)), half);
    return toTexels * glm::dmat4(toClip_) * fromEye;
}

glm::vec2 ShadowMap::offsets() const {
    return {blur_, 0.5f / pixelsPerMeter_};
}

// ---- The maps of a scene

// Around the wide map, so many texels of no caster: all that is read beyond its edge, as light.
static constexpr int rimOfWide = 3;

Shadows::Shadows(gpu::Context& context, int most, const Box& casters, const Box& models,
                 const glm::dvec3& towardsSun)
    : context_(&context), near_(most, casters, towardsSun) {
    glm::ivec2 size(near_.size());
    if (!near_.covers(models)) {
        wide_.emplace(most, models, towardsSun);
        firstOfWide_ = {near_.size() + rimOfWide, rimOfWide};
        size = {firstOfWide_.x + wide_->size() + rimOfWide,
                std::max(near_.size(), wide_->size() + 2 * rimOfWide)};
        // Both look along the sun's light, so that one is a part of the other.
        const glm::dmat4 between = wide_->toTexels(near_.origin(), firstOfWide_) *
                                   glm::inverse(near_.toTexels(near_.origin(), {0, 0}));
        wideScale_ = {between[0].x, between[1].y, between[2].z};
        wideStart_ = glm::vec3(between[3]);
    }
    depth_ = gpu::Texture(context, gpu::Format::depth24, size.x, size.y, "shadow maps");
    target_ = gpu::Framebuffer(context, {}, &depth_, "shadow maps");
    depth_.setShadowCompare();
}

// Sets OpenGL's state for casters, which draw nothing outside of the map.
static void draw(const gpu::Framebuffer& into, const glm::ivec2& first, const ShadowMap& map,
                 const Shadows::Casters& casters) {
    into.bind(first.x, first.y, map.size(), map.size());
    glScissor(first.x, first.y, map.size(), map.size());
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    // Casters outside the box towards the sun still cast shadows; those below it count as at its bottom.
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2);
    casters(map);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_SCISSOR_TEST);
}

void Shadows::drawStill(bool some, const Casters& casters) {
    target_.bind();
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    if (wide_) draw(target_, firstOfWide_, *wide_, casters);
    if (!some) {
        stillTarget_ = {};
        still_ = {};
        return;
    }
    if (!still_) {
        still_ = gpu::Texture(*context_, gpu::Format::depth24, near_.size(), near_.size(), "still shadows");
        stillTarget_ = gpu::Framebuffer(*context_, {}, &still_, "still shadows");
    }
    stillTarget_.bind();
    glClear(GL_DEPTH_BUFFER_BIT);
    draw(stillTarget_, {0, 0}, near_, casters);
}

void Shadows::drawMoving(const Casters& casters) {
    if (stillTarget_) stillTarget_.blitDepthTo(target_);
    draw(target_, {0, 0}, near_, [&](const ShadowMap& map) {
        if (!stillTarget_) glClear(GL_DEPTH_BUFFER_BIT);
        casters(map);
    });
}

void Shadows::clear() {
    draw(target_, {0, 0}, near_, [](const ShadowMap&) { glClear(GL_DEPTH_BUFFER_BIT); });
}

void Shadows::apply(const gpu::Program& program, const Eye& eye) const {
    program.texture("shadowMap", depth_);
    program.set("toShadow", glm::mat4(near_.toTexels(eye.origin, {0, 0})));
    program.set("shadowOffsets", near_.offsets());
    if (!wide_) return;
    program.set("nearTexels", float(near_.size()));
    program.set("wideShadowScale", wideScale_);
    program.set("wideShadowStart", wideStart_);
    program.set("wideShadowOffsets", wide_->offsets());
    const glm::vec2 low = glm::vec2(firstOfWide_) - 1.5f,
                    high = glm::vec2(firstOfWide_ + wide_->size()) + 1.5f;
    program.set("wideBounds", glm::vec4(low, high));
}

}  // namespace shoal
