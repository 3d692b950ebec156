// The tiles of a particle's image, a layer each.
#pragma once

#include "gpu/texture.h"
#include "scene/particle.h"

namespace shoal {

// Loads the tiles in use as layers, from the first, mipmapped each by itself: none bleeds into its neighbour
// at any distance. Rows bottom first; colour is spread over what is clear. Error: no such file, not a PNG,
// tiles that do not fill it, or more of them than the context has layers.
gpu::Texture loadParticleImage(gpu::Context& context, const ParticleImage& image);

}  // namespace shoal
