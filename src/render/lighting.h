// Sun, sky, haze and shadow as the shaders take them (shaders/render/sky.glsl, light.glsl), and how large the
// scene is that they light (bounds.cpp).
#pragma once

#include <string>
#include <vector>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/view.h"
#include "scene/scene.h"

namespace shoal {

struct Plan;
class WaterLight;

struct BoundingSphere {
    glm::dvec3 center{0};
    double radius = 0;  // m; 0: none
};

struct SceneBounds {
    // Bounds of the shadow casters: molecules, the models that carry them, and drawn colliders with an end.
    // All drawn models where there is none of these.
    Box casters;
    Box models;  // of all drawn models, as far as ten times the distance that the camera looks
    // Around the molecules that are placed densely on a model and hide the sky from one another.
    BoundingSphere crown;
};

// From the start state: cheap and constant.
SceneBounds boundsOf(const Scene& scene, const Plan& plan);

// Depth as the sun sees it: an orthographic map around a box.
class ShadowMap {
  public:
    // At most so many texels a side: as many as the blur of its edges asks for.
    ShadowMap(gpu::Context& context, int most, const Box& casters, const glm::dvec3& towardsSun);

    // Binds; sets OpenGL's state for casters; clears, or takes over what another map of the same box has.
    void begin(const ShadowMap* other = nullptr) const;
    void end() const;

    // Whether the sun's light into all of a box goes through the map.
    bool covers(const Box& box) const;

    const Origin& origin() const { return origin_; }  // what `toClip` is relative to
    const glm::mat4& toClip() const { return toClip_; }
    const glm::mat3& toScene() const { return toScene_; }  // columns: right, up, towards the sun
    float pixelsPerMeter() const { return pixelsPerMeter_; }
    const gpu::Texture& depth() const { return depth_; }

    // From places relative to the eye to texture coordinates and depth in [0, 1].
    glm::mat4 toTexture(const Origin& eye) const;
    // What lies so far from a caster is not its shadow, m. x: along the normal; y: towards the sun.
    glm::vec2 offsets() const;

  private:
    gpu::Texture depth_;
    gpu::Framebuffer framebuffer_;
    Origin origin_;
    glm::mat4 toClip_{1};
    glm::mat3 toScene_{1};
    float pixelsPerMeter_ = 1;
    float blur_ = 0;  // m
};

// What the sun casts. Borrows.
struct Shadows {
    const ShadowMap* near = nullptr;  // of everything, about what moves; null: the sun casts no shadows
    const ShadowMap* wide =
        nullptr;  // of what stands still, where `near` ends; null: it does not end in view
};

class Lighting {
  public:
    // `water` may be null: all is in the air. `blends`: something is blended, so light is stored as it is.
    // `samples`: of a pixel. Borrows.
    Lighting(const gpu::ContextInfo& info, const Scene& scene, const BoundingSphere& crown,
             const Shadows& shadows, const WaterLight* water, bool blends, int samples);

    std::vector<std::string> defines() const;      // those of programs that light surfaces, and of the sky's
    std::vector<std::string> toneDefines() const;  // those of the picture
    void applySky(const gpu::Program& program, const Eye& eye) const;
    void applyBeams(const gpu::Program& program, const Eye& eye) const;  // only with water
    void apply(const gpu::Program& program, const Eye& eye) const;

  private:
    void applySun(const gpu::Program& program) const;
    void applyMedium(const gpu::Program& program, const Eye& eye) const;

    glm::vec3 towardsSun_{0}, sun_{0}, zenith_{0}, horizon_{0}, ground_{0};
    float fog_ = 0;
    BoundingSphere crown_;
    Shadows shadows_;
    const WaterLight* water_;
    bool blends_;
    std::vector<std::string> gathers_;
    bool lateDepth_;  // render/light.glsl
};

// Returns the defines of a program that reads four texels at once where the driver can.
std::vector<std::string> gatherDefines(const gpu::ContextInfo& info);

// Unit. Straight down where the direction is zero.
glm::dvec3 towardsSun(const Light& light);

}  // namespace shoal
