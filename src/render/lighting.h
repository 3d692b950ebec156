// Sun, sky, haze and shadow as the shaders take them (shaders/render/sky.glsl, light.glsl).
#pragma once

#include <string>
#include <vector>

#include "gpu/program.h"
#include "render/bounds.h"
#include "render/shadow_map.h"
#include "render/view.h"
#include "scene/scene.h"

namespace shoal {

class WaterLight;

// Texture units, one for each sampler of the room.
namespace unit {
constexpr int positions = 0, normals = 1, records = 2, constants = 3, image = 4, shadowMap = 5, light = 6,
              order = 7, slabs = 8, slabDraws = 9, velocities = 10, sceneDepth = 11, caustics = 12;
}

class Lighting {
  public:
    // `shadow` may be null: the sun casts none; `water` too: all is in the air. `blends`: something is
    // blended, so light is stored as it is. Borrows.
    Lighting(const Scene& scene, const Sphere& crown, const ShadowMap* shadow, const WaterLight* water,
             bool blends);

    // Returns the defines of programs that light surfaces.
    std::vector<std::string> defines() const;
    std::vector<std::string> toneDefines() const;  // those of the picture
    std::vector<std::string> skyDefines() const;
    void applySky(const gpu::Program& program, const Eye& eye) const;
    void applyBeams(const gpu::Program& program, const Eye& eye) const;  // only with water
    void apply(const gpu::Program& program, const Eye& eye) const;
    bool hazy() const { return fog_ > 0 || water_ != nullptr; }

  private:
    void applySun(const gpu::Program& program) const;
    void applyMedium(const gpu::Program& program, const Eye& eye) const;

    glm::vec3 towardsSun_{0}, sun_{0}, zenith_{0}, horizon_{0}, ground_{0};
    float fog_ = 0;
    Sphere crown_;
    const ShadowMap* shadow_;
    const WaterLight* water_;
    bool blends_;
};

// Unit. Straight down where the direction is zero.
glm::dvec3 towardsSun(const Light& light);

}  // namespace shoal
