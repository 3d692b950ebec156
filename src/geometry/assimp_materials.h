// Reads the materials of a model that Assimp has read. For read_assimp.cpp alone.
#pragma once

#include <glm/glm.hpp>

struct aiMaterial;
struct aiScene;

namespace shoal {

struct Mesh;
struct ModelFile;

// Fills the mesh's materials, one for each of the scene's, images, and notes.
void readMaterials(const aiScene& scene, const ModelFile& model, Mesh& mesh);

// The coordinates by which a material's images lie: all as the first of them.
struct TextureCoordinates {
    unsigned set = 0;
    glm::dmat3 transform{1};  // of (u, v, 1)
};
TextureCoordinates textureCoordinatesOf(const aiMaterial& material);

}  // namespace shoal
