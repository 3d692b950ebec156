// From a ParticleType to the "particle" of a group in a scene file.
#pragma once

#include <string>

#include "core/json.h"
#include "scene/particle.h"

namespace shoal {

// Only what differs from the defaults and has an effect; reads back as the same type, but that what had no
// effect is at its default then. `sceneFile`: into which it goes; the image is named relative to its folder.
JsonValue writeParticle(const ParticleType& type, const std::string& sceneFile);

}  // namespace shoal
