// Reads what no reader of our own reads (load_model.cpp chooses) through Assimp.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <set>

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "core/cache_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "geometry/announced.h"
#include "geometry/assimp_materials.h"
#include "geometry/model_reader.h"

namespace shoal {

namespace {

glm::dmat4 matrix(const aiMatrix4x4& m) {
    return glm::dmat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4,
                      m.c4, m.d4);
}

glm::dvec3 vector(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

// Walks the nodes, appending their meshes in scene axes.
class Collector {
  public:
    Collector(const aiScene& scene, const std::string& file) : scene_(scene), file_(file) {}

    void visit(const aiNode& node, const glm::dmat4& parent, int depth = 0) {
        if (depth > 1000) throw fail("has nodes nested deeper than 1000");
        const glm::dmat4 transform = parent * matrix(node.mTransformation);
        Mesh::Object object;
        object.name = node.mName.C_Str();
        object.firstTriangle = static_cast<int>(mesh.triangles.size());
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            if (node.mMeshes[i] >= scene_.mNumMeshes) throw fail("names a mesh that it does not hold");
            const aiMesh& part = *scene_.mMeshes[node.mMeshes[i]];
            if (object.name.empty()) object.name = part.mName.C_Str();
            Mesh::Part piece{part.mName.C_Str(), materialName(part), int(mesh.triangles.size()), 0,
                             part.mMaterialIndex < scene_.mNumMaterials ? int(part.mMaterialIndex) : -1};
            append(part, transform);
            piece.triangleCount = int(mesh.triangles.size()) - piece.firstTriangle;
            if (piece.triangleCount > 0) mesh.parts.push_back(std::move(piece));
        }
        object.triangleCount = static_cast<int>(mesh.triangles.size()) - object.firstTriangle;
        if (object.triangleCount > 0) mesh.objects.push_back(object);
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            if (node.mChildren[i])
                visit(*node.mChildren[i], transform, depth + 1);  // RAW files leave some out
    }

    Mesh mesh;
    bool anyColors = false, anyUvs = false;
    bool points = false;  // takes meshes without triangles

  private:
    Error fail(const std::string& message) const { return Error(Location{file_}, message); }

    std::string materialName(const aiMesh& part) const {
        aiString name;
        if (part.mMaterialIndex < scene_.mNumMaterials)
            scene_.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
        return name.C_Str();
    }

    void append(const aiMesh& part, const glm::dmat4& transform) {
        if (!points && !(part.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) return;
        if (mesh.positions.size() + part.mNumVertices > mostElements)
            throw fail("has more than 2^28 vertices, the most that is read");
        if (mesh.triangles.size() + part.mNumFaces > mostElements)
            throw fail("has more than 2^28 triangles, the most that is read");
        const size_t first = mesh.positions.size();
        appendVertices(part, transform);
        appendBones(part, first);

        const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0;
        for (unsigned i = 0; i < part.mNumFaces; ++i) {
            const aiFace& face = part.mFaces[i];
            if (face.mNumIndices != 3) continue;  // lines and points
            glm::ivec3 triangle;
            for (int corner = 0; corner < 3; ++corner) {
                const unsigned index = face.mIndices[corner];
                if (index >= part.mNumVertices)
                    throw fail(
                        concat("has a triangle with vertex ", index, " of a mesh of ", part.mNumVertices));
                triangle[corner] = static_cast<int>(first + index);
            }
            if (mirrored) std::swap(triangle.y, triangle.z);  // keeps anticlockwise in front
            mesh.triangles.push_back(triangle);
        }
    }

    void appendVertices(const aiMesh& part, const glm::dmat4& transform) {
        // The inverse transpose up to a factor that normalising removes; defined for flat transforms too.
        const glm::dmat3 m(transform);
        const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        const double side = glm::determinant(m) < 0 ? -1 : 1;
        anyColors = anyColors || part.HasVertexColors(0);
        TextureCoordinates coordinates;
        if (part.mMaterialIndex < scene_.mNumMaterials)
            coordinates = textureCoordinatesOf(*scene_.mMaterials[part.mMaterialIndex]);
        const unsigned set = part.HasTextureCoords(coordinates.set) ? coordinates.set : 0;
        anyUvs = anyUvs || part.HasTextureCoords(set);
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            const glm::dvec3 position(transform * glm::dvec4(vector(part.mVertices[i]), 1));
            if (!isFinite(position))
                throw fail(concat("vertex ", i, " of mesh \"", part.mName.C_Str(),
                                  "\" is not finite, expected three finite numbers"));
            if (!isWithinReach(position))
                throw fail(concat("vertex ", i, " of mesh \"", part.mName.C_Str(), "\" lies beyond ",
                                  farthest, ", the farthest that is read"));
            mesh.positions.push_back(position);

            glm::dvec3 normal(0);
            if (part.HasNormals()) normal = cofactor * vector(part.mNormals[i]) * side;
            mesh.normals.push_back(unit(normal));

            glm::dvec3 color(1);
            if (part.HasVertexColors(0)) {
                const aiColor4D& c = part.mColors[0][i];
                color = {c.r, c.g, c.b};
            }
            mesh.colors.push_back(isFinite(color) ? color : glm::dvec3(1));

            glm::dvec3 uv(0);
            if (part.HasTextureCoords(set))
                uv = coordinates.transform * glm::dvec3(glm::dvec2(vector(part.mTextureCoords[set][i])), 1);
            mesh.uvs.push_back(isFinite(uv) ? glm::dvec2(uv) : glm::dvec2(0));
        }
    }

    // Animations are not read: a bone is a name for the vertices that it moves most.
    void appendBones(const aiMesh& part, size_t first) {
        mesh.bones.resize(mesh.positions.size(), -1);
        std::vector<float> heaviest(part.mNumVertices, 0.0f);
        for (unsigned b = 0; b < part.mNumBones; ++b) {
            const aiBone& bone = *part.mBones[b];
            const std::string name = bone.mName.C_Str();
            const auto known = std::find(mesh.boneNames.begin(), mesh.boneNames.end(), name);
            const int number = int(known - mesh.boneNames.begin());
            if (known == mesh.boneNames.end()) mesh.boneNames.push_back(name);
            for (unsigned i = 0; i < bone.mNumWeights; ++i) {
                const aiVertexWeight& weight = bone.mWeights[i];
                if (weight.mVertexId >= part.mNumVertices || !(weight.mWeight > heaviest[weight.mVertexId]))
                    continue;
                heaviest[weight.mVertexId] = weight.mWeight;
                mesh.bones[first + weight.mVertexId] = number;
            }
        }
    }

    const aiScene& scene_;
    const std::string& file_;
};

// The files that a model consists of. A device has no end, and a pipe would wait for ever.
class ModelFiles : public Assimp::IOSystem {
  public:
    explicit ModelFiles(std::function<void(uint64_t)> opened) : opened_(std::move(opened)) {}

    bool Exists(const char* file) const override {  // Assimp's own opens it to see
        std::error_code code;
        return mayOpen(file) && std::filesystem::is_regular_file(file, code);
    }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        std::error_code code;
        if (!Exists(file)) return nullptr;
        const FileReader readable(file);  // one that is sparse is refused
        const uint64_t bytes = std::filesystem::file_size(file, code);
        if (!code && seen_.insert(file).second) opened_(bytes);
        return files_.Open(file, mode);
    }
    void Close(Assimp::IOStream* file) override { files_.Close(file); }
    char getOsSeparator() const override { return files_.getOsSeparator(); }

  private:
    Assimp::DefaultIOSystem files_;
    std::function<void(uint64_t)> opened_;
    std::set<std::string> seen_;
};

// Metres in a unit of the file. FBX says how many centimetres its unit has; COLLADA's is in Assimp's root
// node, glTF's is the metre, and other formats say none.
double metresOf(const aiScene& scene) {
    float centimetres = 0;
    if (!scene.mMetaData || !scene.mMetaData->Get("UnitScaleFactor", centimetres)) return 1;
    return std::isfinite(centimetres) && centimetres > 0 ? double(centimetres) / 100 : 1;
}

// Assimp's messages quote the file, whatever it holds.
std::string oneLine(std::string text) {
    if (text.empty()) return "Assimp does not say why";
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    constexpr size_t longest = 300;
    return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

// Assimp catches what its containers throw for want of memory, and tells their words.
bool tellsOfMemory(const std::string& message) {
    for (const char* word :
         {"std::bad_alloc", "std::bad_array_new_length", "vector::", "larger than max_size"})
        if (message.find(word) != std::string::npos) return true;
    return false;
}

}  // namespace

Mesh readWithAssimp(const ModelFile& model) {
    const Location location{model.name};
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);  // invents no mesh of bones or nodes
    importer.SetIOHandler(new ModelFiles(model.opened));                  // which the importer deletes
    const aiScene* scene = importer.ReadFile(model.name, aiProcess_Triangulate);
    if (!scene && tellsOfMemory(importer.GetErrorString())) throw std::bad_alloc();
    if (!scene || !scene->mRootNode)
        throw Error(location, "cannot be read as a model: ", oneLine(importer.GetErrorString()));

    Collector collector(*scene, model.name);
    const glm::dmat4 metres(glm::dmat3(metresOf(*scene)));
    collector.visit(*scene->mRootNode, metres);
    if (collector.mesh.triangles.empty()) {  // a cloud of points
        collector.points = true;
        collector.visit(*scene->mRootNode, metres);
    }
    Mesh mesh = std::move(collector.mesh);
    if (const std::optional<size_t> announced = announcedTriangles(model.name);
        announced && *announced != mesh.triangles.size())
        mesh.losses.push_back(concat("its text has ", many(int64_t(*announced), "triangle", "triangles"),
                                     ", and its reader gives ", mesh.triangles.size()));
    tellOfRounding(mesh);
    if (!collector.anyColors) mesh.colors.clear();
    if (!collector.anyUvs) mesh.uvs.clear();
    if (mesh.boneNames.empty()) mesh.bones.clear();
    readMaterials(*scene, model, mesh);
    return mesh;
}

}  // namespace shoal
