// Sliders for the looks of one group of point particles.
#pragma once

#include "scene/edit_limits.h"

namespace shoal::window {

class ParticleEditor {
  public:
    explicit ParticleEditor(const ParticleType& type) : limits_(limitsOf(type)) {}

    // Whether the user changed the type in this frame. `ages`: some are born or die.
    bool draw(ParticleType& type, bool ages);

  private:
    bool drawShape(ParticleType& type, bool ages) const;
    bool drawTurning(ParticleType& type) const;
    bool drawColors(ParticleType& type) const;
    bool drawImage(ParticleImage& image) const;
    bool drawBlending(ParticleType& type) const;

    LooksLimits limits_;
};

}  // namespace shoal::window
