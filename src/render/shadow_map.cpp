#include "render/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace shoal {

ShadowMap::ShadowMap(gpu::Context& context, int size, const Box& casters, const glm::dvec3& towardsSun)
    : depth_(context, gpu::Format::depth24, size, size, "shadow map"),
      framebuffer_(context, {}, &depth_, "shadow map"),
      origin_(0.5 * (casters.low + casters.high)) {
    depth_.setShadowCompare();

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
    pixelsPerMeter_ = float(size / (2 * reach));
}

void ShadowMap::begin() const {
    framebuffer_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    // Casters outside the box towards the sun still cast shadows; those below it count as at its bottom.
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowMap::end() const {
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
}

glm::mat4 ShadowMap::toTexture(const Origin& eye) const {
    const glm::dmat4 fromEye = glm::translate(glm::dmat4(1), eye.exact - origin_.exact);
    const glm::dmat4 toUnit = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
    return glm::mat4(toUnit * glm::dmat4(toClip_) * fromEye);
}

glm::vec3 ShadowMap::filter() const {
    const float texel = 1 / pixelsPerMeter_;
    // The sun is not a point: an edge a few metres up is blurred by centimetres, as far as 16 taps reach.
    const float radius = std::clamp(0.02f, 2 * texel, 5 * texel);
    return {radius / (texel * float(depth_.width())), radius, 0.5f * texel};
}

}  // namespace shoal
