// Sliders for the looks of one group of point particles.
#pragma once

#include "scene/particle.h"

namespace shoal::app {

class ParticleEditor {
  public:
    explicit ParticleEditor(const ParticleType& type);

    // Whether the user changed the type in this frame. `ages`: some are born or die.
    bool draw(ParticleType& type, bool ages);

  private:
    bool drawShape(ParticleType& type, bool ages) const;
    bool drawTurning(ParticleType& type) const;
    bool drawColors(ParticleType& type) const;
    bool drawImage(ParticleImage& image) const;
    bool drawBlending(ParticleType& type) const;

    double mostSize_, mostMass_, mostSpin_;  // m, kg, rad/s
};

}  // namespace shoal::app
