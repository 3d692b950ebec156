// What the sun casts: depth as it sees the scene, in maps that shaders compare with
// (shaders/render/light.glsl).
#pragma once

#include <functional>
#include <optional>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/view.h"
#include "scene/scene.h"

namespace shoal {

// An orthographic map around a box.
class ShadowMap {
  public:
    // At most so many texels a side: as many as the blur of its edges asks for.
    ShadowMap(int most, const Box& casters, const glm::dvec3& towardsSun);

    // Whether the sun's light into all of a box goes through the map.
    bool covers(const Box& box) const;

    int size() const { return size_; }                // texels a side
    const Origin& origin() const { return origin_; }  // what `toClip` is relative to
    const glm::mat4& toClip() const { return toClip_; }
    const glm::mat3& toScene() const { return toScene_; }  // columns: right, up, towards the sun
    float pixelsPerMeter() const { return pixelsPerMeter_; }

    // From places relative to the eye to texels of a texture, in which the map begins at `first`, and to
    // depth in [0, 1].
    glm::dmat4 toTexels(const Origin& eye, const glm::ivec2& first) const;
    // What lies so far from a caster is not its shadow, m. x: along the normal; y: towards the sun.
    glm::vec2 offsets() const;

  private:
    Origin origin_;
    glm::mat4 toClip_{1};
    glm::mat3 toScene_{1};
    int size_ = 0;
    float pixelsPerMeter_ = 1;
    float blur_ = 0;  // m
};

// The maps of a scene, beside one another in one texture, so that a pixel reads only the one that it lies in.
class Shadows {
  public:
    // A map of everything about what moves, and another of what stands still where that one does not cover
    // `models`.
    Shadows(gpu::Context& context, int most, const Box& casters, const Box& models,
            const glm::dvec3& towardsSun);

    // Draws casters into the map that is bound.
    using Casters = std::function<void(const ShadowMap& map)>;
    // What stands still: before the first picture, and when it has changed. `some`: whether there is any.
    void drawStill(bool some, const Casters& casters);
    void drawMoving(const Casters& casters);  // for each picture
    void clear();                             // in the first map nothing lies in the shade

    bool wide() const { return wide_.has_value(); }
    void apply(const gpu::Program& program, const Eye& eye) const;

  private:
    gpu::Context* context_;
    ShadowMap near_;
    std::optional<ShadowMap>
        wide_;                   // of what stands still, where the first ends; none: it does not end in view
    glm::ivec2 firstOfWide_{0};  // texel
    glm::vec3 wideScale_{1}, wideStart_{0};  // from texel and depth in the first map to those in the wide one
    gpu::Texture depth_, still_;             // `still_`: of the first map, what stands still alone
    gpu::Framebuffer target_, stillTarget_;
};

// Unit. Straight down where the direction is zero.
glm::dvec3 towardsSun(const Light& light);

}  // namespace shoal
