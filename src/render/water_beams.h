// Beams of light through the water, drawn after everything else at a quarter of the picture's size, and added
// to its light (shaders/water/rays.frag).
#pragma once

#include <string>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "render/lighting.h"
#include "render/water_light.h"

namespace shoal {

class WaterBeams {
  public:
    // None where the water has no rays.
    WaterBeams(gpu::Context& context, const std::string& shaderRoot, const WaterLight* water);

    void resize(int width, int height);  // of the picture
    // `sceneDepth`: of all that is not blended.
    void draw(const Eye& eye, const Lighting& lighting, const gpu::Texture& sceneDepth) const;
    const gpu::Texture& light() const { return light_; }
    explicit operator bool() const { return water_ != nullptr; }

  private:
    gpu::Context* context_;
    const WaterLight* water_;
    gpu::Program program_;
    gpu::VertexArray empty_;
    gpu::Texture light_;
    gpu::Framebuffer target_;
};

}  // namespace shoal
