// The nodes of a glTF file. For read_gltf.cpp alone.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/gltf_file.h"

namespace shoal {

struct GltfNode {
    glm::dmat4 local{1}, global{1};  // to its parent, and to the scene
    int parent = -1, mesh = -1, skin = -1;
    bool hidden = false;  // or within what is
    std::vector<int> children;
    std::string name;
};

// Error: a child of two nodes, or a node within itself.
std::vector<GltfNode> readGltfNodes(GltfFile& file);
// The roots of the scene that the file shows; without scenes, all that are nobody's children.
std::vector<int> gltfRoots(GltfFile& file, const std::vector<GltfNode>& nodes,
                           std::vector<std::string>& notes);
// Where the mesh of a node stands: once, or where its instances are (EXT_mesh_gpu_instancing).
std::vector<glm::dmat4> gltfPlaces(GltfFile& file, JsonReader& from, const GltfNode& node);

}  // namespace shoal
