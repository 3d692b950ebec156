// Reads the materials of a glTF file. For read_gltf.cpp alone.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "geometry/gltf_file.h"

namespace shoal {

// The coordinates by which a material's images lie: all as the first of them.
struct GltfCoordinates {
    int set = 0;
    glm::dmat3 transform{1, 0, 0, 0, -1, 0, 0, 1, 1};  // of (u, v, 1), to a v that points up
};

// Fills the mesh's materials, one for each of the file's, images and notes; returns the coordinates of each.
std::vector<GltfCoordinates> readGltfMaterials(GltfFile& file, const ModelFile& model, Mesh& mesh);

}  // namespace shoal
