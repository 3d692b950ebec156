// Draws a group of point particles by their type (scene/particle.h): dots, sprites or quads, whose looks the
// vertex stage works out from age and seed (shaders/particles). What the type does not use is not in the
// shaders.
//
// An instance of a draw is a batch of particles that share one stream of corners: an instance each would
// leave most lanes of a GPU, or of a CPU's vectors, idle.
//
// Particles that are not blended cast shadows; blended ones do not.
#pragma once

#include "render/group_drawer.h"
#include "scene/particle.h"

namespace shoal {

class ParticleDrawer : public GroupDrawer {
  public:
    // `pixelsPerMeter`: about where the camera looks. Error: the image (render/particle_image.h).
    ParticleDrawer(gpu::Context& context, const std::string& shaderRoot, gpu::Programs& programs,
                   const ParticleType& type, const GroupPlan& plan, size_t index, const Lighting& lighting,
                   double pixelsPerMeter);

    // Other looks, from the next picture on. False, and nothing changes: they need another image, order or
    // stream of corners.
    bool change(const ParticleType& type, const Lighting& lighting);

    bool readsDepth() const override { return type_.softness > 0 && type_.blend != Blend::none; }
    const gpu::Program& useLit(const StateView& state, const DrawInputs& inputs) override;
    const gpu::Program& useDepth(const StateView& state, const ShadowMap& shadow, double time) override;

  private:
    void makeStream();
    void chooseShaders(const Lighting& lighting);
    std::vector<std::string> defines() const;
    void setType(const gpu::Program& program) const;
    void setTime(const gpu::Program& program, double time) const;
    void setColors(const gpu::Program& program) const;

    ParticleType type_;
    double pixelsPerMeter_;
    bool ages_;  // some are born or die
    gpu::Buffer indices_;
    gpu::Texture image_;  // none: a dot
};

}  // namespace shoal
