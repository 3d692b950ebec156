#include "scene/load_model.h"

#include <cmath>
#include <filesystem>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "core/error.h"
#include "core/file.h"
#include "scene/model_files.h"

namespace shoal {

namespace {

glm::dmat4 matrix(const aiMatrix4x4& m) {
    return glm::dmat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4,
                      m.c4, m.d4);
}

glm::dvec3 vector(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// From sRGB (IEC 61966-2-1) to linear.
double linear(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

bool holdsSrgb(const std::string& file) {
    const std::string ending = lowerExtension(file);
    return ending == ".obj" || ending == ".ply";
}

// Walks the nodes, appending their meshes in scene axes.
class Collector {
  public:
    Collector(const aiScene& scene, const std::string& file)
        : scene_(scene), file_(file), srgb_(holdsSrgb(file)) {}

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
            Mesh::Part piece{part.mName.C_Str(), materialName(part), int(mesh.triangles.size()), 0};
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

  private:
    Error fail(const std::string& message) const { return Error(Location{file_, 0, 0, {}}, message); }

    std::string materialName(const aiMesh& part) const {
        aiString name;
        if (part.mMaterialIndex < scene_.mNumMaterials)
            scene_.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
        return name.C_Str();
    }

    void append(const aiMesh& part, const glm::dmat4& transform) {
        if (!(part.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) return;
        if (mesh.positions.size() + part.mNumVertices > size_t{1} << 28)
            throw fail("has more than 2^28 vertices, the most that is read");
        const size_t first = mesh.positions.size();
        appendVertices(part, transform);

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
        anyUvs = anyUvs || part.HasTextureCoords(0);
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            const glm::dvec3 position(transform * glm::dvec4(vector(part.mVertices[i]), 1));
            if (!finite(position))
                throw fail(concat("vertex ", i, " of mesh \"", part.mName.C_Str(),
                                  "\" is not finite, expected three finite numbers"));
            mesh.positions.push_back(position);

            glm::dvec3 normal(0);
            if (part.HasNormals()) normal = cofactor * vector(part.mNormals[i]) * side;
            const double length = glm::length(normal);
            mesh.normals.push_back(finite(normal) && length > 0 ? normal / length : glm::dvec3(0));

            glm::dvec3 color(1);
            if (part.HasVertexColors(0)) {
                const aiColor4D& c = part.mColors[0][i];
                color = {c.r, c.g, c.b};
                if (srgb_) color = {linear(color.r), linear(color.g), linear(color.b)};
            }
            mesh.colors.push_back(finite(color) ? color : glm::dvec3(1));

            glm::dvec3 uv(0);
            if (part.HasTextureCoords(0)) uv = vector(part.mTextureCoords[0][i]);
            mesh.uvs.push_back(finite(uv) ? glm::dvec2(uv) : glm::dvec2(0));
        }
    }

    const aiScene& scene_;
    const std::string& file_;
    bool srgb_;
};

}  // namespace

Mesh loadMesh(const std::string& file) {
    refuseOutside(file);
    const Location location{file, 0, 0, {}};
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (status.type() == std::filesystem::file_type::not_found) throw Error(location, "no such file");
    if (status.type() == std::filesystem::file_type::directory)
        throw Error(location, "is a folder, expected a model file");

    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFiles);  // which it deletes
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
    if (!scene || !scene->mRootNode)
        throw Error(location, concat("cannot be read as a model: ", importer.GetErrorString()));

    Collector collector(*scene, file);
    collector.visit(*scene->mRootNode, glm::dmat4(1));
    Mesh mesh = std::move(collector.mesh);
    if (mesh.triangles.empty()) throw Error(location, "has no triangles, expected a mesh with at least one");
    if (!collector.anyColors) mesh.colors.clear();
    if (!collector.anyUvs) mesh.uvs.clear();
    completeMesh(mesh);
    return mesh;
}

}  // namespace shoal
