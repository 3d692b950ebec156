// Light in water (scene/water.h), as the shaders of the picture take it (shaders/water): the net of caustics,
// drawn anew for every picture from the waves of the surface, and the waves themselves.
//
// Waves repeat on square tiles of the surface, eight meshes wide. Where refraction carries the light that
// enters a small triangle of the surface is again a triangle, as much brighter as it is smaller [Arvo 1986];
// it is drawn as in [Wallace 2011]. Beams of light through the water are added to the picture's light.
#pragma once

#include <array>
#include <string>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/view.h"
#include "scene/water.h"

namespace shoal {

class Lighting;

class WaterLight {
  public:
    static constexpr int waveCount = 14;  // shaders/water/waves.glsl

    WaterLight(gpu::Context& context, const Water& water);

    // The net at a time, s. Leaves its own framebuffer bound.
    void draw(double time);
    void applyMedium(const gpu::Program& program, const Eye& eye) const;  // water/medium.glsl
    void applyWaves(const gpu::Program& program, double time) const;      // water/waves.glsl

    const Water& water() const { return water_; }
    const gpu::Texture& caustics() const { return caustics_; }  // R32F, 1: as under a calm surface

  private:
    double tile() const;  // m

    Water water_;
    gpu::Program program_;
    gpu::Buffer indices_;
    gpu::VertexArray grid_;
    gpu::Texture caustics_;
    gpu::Framebuffer target_;
};

// Beams of light, drawn after everything else at a quarter of the picture's size (shaders/render/beams.frag).
class WaterBeams {
  public:
    // None where the water has no rays.
    WaterBeams(gpu::Context& context, const WaterLight* water);

    void resize(int width, int height);  // of the picture
    // `sceneDepth`: of all that is not blended.
    void draw(const Eye& eye, const Lighting& lighting, const gpu::Texture& sceneDepth) const;
    const gpu::Texture& light() const { return light_; }
    explicit operator bool() const { return water_ != nullptr; }

  private:
    gpu::Context* context_;
    const WaterLight* water_;
    gpu::Program program_;
    gpu::Texture light_;
    gpu::Framebuffer target_;
};

}  // namespace shoal
