// glTF 2.0 (ISO/IEC 12113): meshes, their materials and images, and a camera, in one binary file (.glb).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "exchange/drawn_mesh.h"

namespace shoal::exchange {

// Meshes without positions are left out. Texture coordinates are turned over, as glTF's begin at the upper
// left. Error: more bytes than a .glb holds (4 GiB).
std::vector<std::byte> encodeGlb(const std::vector<DrawnMesh>& meshes,
                                 const std::optional<Camera>& camera = {});

}  // namespace shoal::exchange
