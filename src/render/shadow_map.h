// Depth as the sun sees it: one orthographic map around whatever casts the shadows that matter.
#pragma once

#include <glm/glm.hpp>

#include "gpu/framebuffer.h"
#include "gpu/texture.h"
#include "render/view.h"
#include "scene/scene.h"

namespace shoal {

class ShadowMap {
  public:
    ShadowMap(gpu::Context& context, int size, const Box& casters, const glm::dvec3& towardsSun);

    void begin() const;  // binds and clears; OpenGL's state for casters
    void end() const;

    const Origin& origin() const { return origin_; }  // what `toClip` is relative to
    const glm::mat4& toClip() const { return toClip_; }
    const glm::mat3& toScene() const { return toScene_; }  // columns: right, up, towards the sun
    float pixelsPerMeter() const { return pixelsPerMeter_; }
    const gpu::Texture& depth() const { return depth_; }

    // From places relative to the eye to texture coordinates and depth in [0, 1].
    glm::mat4 toTexture(const Origin& eye) const;
    // x: filter radius in texture units; y: offset along the normal and z: towards the sun, in m.
    glm::vec3 filter() const;

  private:
    gpu::Texture depth_;
    gpu::Framebuffer framebuffer_;
    Origin origin_;
    glm::mat4 toClip_{1};
    glm::mat3 toScene_{1};
    float pixelsPerMeter_ = 1;
};

}  // namespace shoal
