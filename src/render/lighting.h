// Sun, sky, haze and shadow as the shaders take them (shaders/render/sky.glsl, light.glsl), and how large the
// scene is that they light (bounds.cpp).
#pragma once

#include <string>
#include <vector>

#include "gpu/program.h"
#include "render/shadows.h"
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

class Lighting {
  public:
    // `shadows` may be null: the sun casts none; so may `water`: all is in the air. `blends`: something is
    // blended, so light is stored as it is. `samples`: of a pixel. Borrows.
    Lighting(const gpu::ContextInfo& info, const Scene& scene, const BoundingSphere& crown,
             const Shadows* shadows, const WaterLight* water, bool blends, int samples);

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
    const Shadows* shadows_;
    const WaterLight* water_;
    bool blends_;
    std::vector<std::string> gathers_;
    bool lateDepth_;  // render/light.glsl
};

// Returns the defines of a program that reads four texels at once where the driver can.
std::vector<std::string> gatherDefines(const gpu::ContextInfo& info);

}  // namespace shoal
