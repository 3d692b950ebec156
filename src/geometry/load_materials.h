// Reads the materials of a model that Assimp has read. For load_model.cpp alone.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <glm/glm.hpp>

struct aiMaterial;
struct aiScene;

namespace shoal {

struct Mesh;

// Fills the mesh's materials, one for each of the scene's, images, and notes. Looks for images beside `file`;
// `opened` is told of each that it reads.
void readMaterials(const aiScene& scene, const std::string& file, const std::function<void(uint64_t)>& opened,
                   Mesh& mesh);

// The coordinates by which a material's images lie: all as the first of them.
struct TextureCoordinates {
    unsigned set = 0;
    glm::dmat3 transform{1};  // of (u, v, 1)
};
TextureCoordinates textureCoordinatesOf(const aiMaterial& material);

}  // namespace shoal
