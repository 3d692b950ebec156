// A picture for compositors: light, depth and a mask of each group in one OpenEXR file.
#pragma once

#include <filesystem>

#include "render/renderer.h"

namespace shoal::app {

// Channels R, G, B, A (half floats, multiplied by A), Z (m) and mask.NAME of each group; in NAME _ stands for
// all but letters and digits. Error: cannot be written.
void writeLayers(const std::filesystem::path& file, const PictureLayers& layers);

}  // namespace shoal::app
