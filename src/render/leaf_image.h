// The picture that a molecule is cut out of, made ready for mipmaps.
#pragma once

#include "core/image.h"
#include "gpu/texture.h"
#include "molecule/molecule.h"

namespace shoal {

// Returns the image as RGBA, rows bottom first. Colour is spread from inside the shape, where alpha is at
// least `inside`, over what is cut away, so that smaller mip levels do not mix the background's colour into
// the rim.
Image bledImage(const Image& image, int inside = 128);

// Mipmapped. Error: no such file, or not a PNG.
gpu::Texture loadLeafImage(gpu::Context& context, const Molecule& molecule);

}  // namespace shoal
