#include "geometry/mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <new>
#include <set>

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "core/cache_folder.h"
#include "core/confined.h"
#include "core/error.h"
#include "core/file.h"
#include "core/srgb.h"
#include "geometry/load_materials.h"

namespace shoal {

namespace {

constexpr size_t mostElements = size_t{1} << 28;  // vertices, and triangles
constexpr double farthest = 1e30;                 // m; beyond, volumes and their squares would overflow

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

  private:
    Error fail(const std::string& message) const { return Error(Location{file_}, message); }

    std::string materialName(const aiMesh& part) const {
        aiString name;
        if (part.mMaterialIndex < scene_.mNumMaterials)
            scene_.mMaterials[part.mMaterialIndex]->Get(AI_MATKEY_NAME, name);
        return name.C_Str();
    }

    void append(const aiMesh& part, const glm::dmat4& transform) {
        if (!(part.mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) return;
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
            if (!finite(position))
                throw fail(concat("vertex ", i, " of mesh \"", part.mName.C_Str(),
                                  "\" is not finite, expected three finite numbers"));
            if (!(std::max({std::abs(position.x), std::abs(position.y), std::abs(position.z)}) <= farthest))
                throw fail(concat("vertex ", i, " of mesh \"", part.mName.C_Str(), "\" lies beyond ",
                                  farthest, ", the farthest that is read"));
            mesh.positions.push_back(position);

            glm::dvec3 normal(0);
            if (part.HasNormals()) normal = cofactor * vector(part.mNormals[i]) * side;
            const double length = glm::length(normal);
            mesh.normals.push_back(finite(normal) && length > 0 ? normal / length : glm::dvec3(0));

            glm::dvec3 color(1);
            if (part.HasVertexColors(0)) {
                const aiColor4D& c = part.mColors[0][i];
                color = {c.r, c.g, c.b};
                if (srgb_) color = {linearOfSrgb(color.r), linearOfSrgb(color.g), linearOfSrgb(color.b)};
            }
            mesh.colors.push_back(finite(color) ? color : glm::dvec3(1));

            glm::dvec3 uv(0);
            if (part.HasTextureCoords(set))
                uv = coordinates.transform * glm::dvec3(glm::dvec2(vector(part.mTextureCoords[set][i])), 1);
            mesh.uvs.push_back(finite(uv) ? glm::dvec2(uv) : glm::dvec2(0));
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
    bool srgb_;
};

// The files that a model consists of. A device has no end, and a pipe would wait for ever.
class ModelFiles : public Assimp::DefaultIOSystem {
  public:
    explicit ModelFiles(std::function<void(uint64_t)> opened) : opened_(std::move(opened)) {}

    bool Exists(const char* file) const override {  // Assimp's own opens it to see
        std::error_code code;
        return mayOpen(file) && std::filesystem::is_regular_file(file, code);
    }

    Assimp::IOStream* Open(const char* file, const char* mode) override {
        std::error_code code;
        if (!Exists(file)) return nullptr;
        const uint64_t bytes = std::filesystem::file_size(file, code);
        if (!code && seen_.insert(file).second) opened_(bytes);
        return DefaultIOSystem::Open(file, mode);
    }

  private:
    std::function<void(uint64_t)> opened_;
    std::set<std::string> seen_;
};

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

Mesh readModel(const std::string& file, std::function<void(uint64_t)> opened) {
    const Location location{file};
    Assimp::Importer importer;
    importer.SetIOHandler(new ModelFiles(opened));  // which the importer deletes
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
    if (!scene && tellsOfMemory(importer.GetErrorString())) throw std::bad_alloc();
    if (!scene || !scene->mRootNode)
        throw Error(location, "cannot be read as a model: ", oneLine(importer.GetErrorString()));

    Collector collector(*scene, file);
    collector.visit(*scene->mRootNode, glm::dmat4(1));
    Mesh mesh = std::move(collector.mesh);
    if (mesh.triangles.empty()) throw Error(location, "has no triangles, expected a mesh with at least one");
    if (!collector.anyColors) mesh.colors.clear();
    if (!collector.anyUvs) mesh.uvs.clear();
    if (mesh.boneNames.empty()) mesh.bones.clear();
    readMaterials(*scene, file, opened, mesh);
    return mesh;
}

// Names end in a zero byte; the numbers are the first triangles and their counts, in the same order.
struct Names {
    std::vector<char> text;
    std::vector<int> numbers;
    size_t at = 0;  // in the text, of the next name

    void add(const std::string& name) {
        text.insert(text.end(), name.c_str(), name.c_str() + name.size() + 1);
    }
    std::string next() {
        const auto end = std::find(text.begin() + std::ptrdiff_t(at), text.end(), '\0');
        std::string out(text.begin() + std::ptrdiff_t(at), end);
        at = std::min(at + out.size() + 1, text.size());
        return out;
    }
};

void put(ToParent& parent, const Mesh& mesh) {
    parent.put(mesh.positions);
    parent.put(mesh.normals);
    parent.put(mesh.colors);
    parent.put(mesh.uvs);
    parent.put(mesh.triangles);
    Names objects, parts;
    for (const Mesh::Object& object : mesh.objects) {
        objects.add(object.name);
        objects.numbers.insert(objects.numbers.end(), {object.firstTriangle, object.triangleCount});
    }
    for (const Mesh::Part& part : mesh.parts) {
        parts.add(part.mesh);
        parts.add(part.material);
        parts.numbers.insert(parts.numbers.end(), {part.firstTriangle, part.triangleCount, part.look});
    }
    const auto listed = [](const std::vector<std::string>& texts) {
        Names out;
        for (const std::string& text : texts)
            out.add(text);
        out.numbers = {int(texts.size())};
        return out;
    };
    parent.put(mesh.bones);
    for (const Names& names : {objects, parts, listed(mesh.notes), listed(mesh.boneNames)}) {
        parent.put(names.text);
        parent.put(names.numbers);
    }
    parent.put(mesh.materials);
    std::vector<glm::ivec2> sizes;
    for (const Image& image : mesh.images)
        sizes.emplace_back(image.width, image.height);
    parent.put(sizes);
    for (const Image& image : mesh.images)
        parent.put(image.pixels);
}

// The child's memory may be another's by now: nothing that it says is taken for granted.
void checkWhole(const Mesh& mesh, const Location& location) {
    const size_t count = mesh.positions.size();
    const auto fits = [&](int first, int triangles) {
        return first >= 0 && triangles >= 0 && size_t(first) + size_t(triangles) <= mesh.triangles.size();
    };
    bool whole = count <= mostElements && mesh.triangles.size() <= mostElements && !mesh.triangles.empty() &&
                 mesh.normals.size() == count && (mesh.colors.empty() || mesh.colors.size() == count) &&
                 (mesh.uvs.empty() || mesh.uvs.size() == count) &&
                 (mesh.bones.empty() || mesh.bones.size() == count);
    for (const int bone : mesh.bones)
        whole = whole && bone >= -1 && bone < int(mesh.boneNames.size());
    for (const glm::ivec3& t : mesh.triangles)
        whole = whole && std::min({t.x, t.y, t.z}) >= 0 && size_t(std::max({t.x, t.y, t.z})) < count;
    for (const auto* vectors : {&mesh.positions, &mesh.normals, &mesh.colors})
        for (const glm::dvec3& v : *vectors)
            whole = whole && finite(v);
    for (const Mesh::Object& object : mesh.objects)
        whole = whole && fits(object.firstTriangle, object.triangleCount);
    for (const Mesh::Part& part : mesh.parts)
        whole = whole && fits(part.firstTriangle, part.triangleCount) && part.look >= -1 &&
                part.look < int(mesh.materials.size());
    for (const Image& image : mesh.images)
        whole = whole && std::min(image.width, image.height) > 0 &&
                std::max(image.width, image.height) <= largestModelImage &&
                image.pixels.size() == size_t(image.width) * size_t(image.height) * 4;
    for (const SurfaceMaterial& look : mesh.materials) {
        for (const int image : {look.colorImage, look.emissiveImage, look.normalImage, look.roughnessImage})
            whole = whole && image >= -1 && image < int(mesh.images.size());
        for (const double number :
             {look.color.r, look.color.g, look.color.b, look.color.a, look.emissive.r, look.emissive.g,
              look.emissive.b, look.metallic, look.roughness, look.normalScale, look.alphaCut})
            whole = whole && std::isfinite(number);
        whole = whole && int(look.alpha) >= 0 && int(look.alpha) <= int(SurfaceMaterial::Alpha::blend);
    }
    if (!whole) throw Error(location, "cannot be read: its reader went astray");
}

Mesh readConfined(const std::string& file) {
    const Location location{file};
    Confined child(location, ConfinedLimits{}, [&](ToParent& parent) {
        put(parent, readModel(file, [&](uint64_t bytes) { parent.opened(bytes); }));
    });
    Mesh mesh;
    mesh.positions = child.get<glm::dvec3>();
    mesh.normals = child.get<glm::dvec3>();
    mesh.colors = child.get<glm::dvec3>();
    mesh.uvs = child.get<glm::dvec2>();
    mesh.triangles = child.get<glm::ivec3>();
    mesh.bones = child.get<int>();
    Names objects{child.get<char>(), child.get<int>()};
    for (size_t i = 0; i + 1 < objects.numbers.size(); i += 2)
        mesh.objects.push_back({objects.next(), objects.numbers[i], objects.numbers[i + 1]});
    Names parts{child.get<char>(), child.get<int>()};
    for (size_t i = 0; i + 2 < parts.numbers.size(); i += 3) {
        std::string name = parts.next(), material = parts.next();
        mesh.parts.push_back({std::move(name), std::move(material), parts.numbers[i], parts.numbers[i + 1],
                              parts.numbers[i + 2]});
    }
    for (std::vector<std::string>* texts : {&mesh.notes, &mesh.boneNames}) {
        Names names{child.get<char>(), child.get<int>()};
        for (int i = 0; !names.numbers.empty() && i < names.numbers.front() && names.at < names.text.size();
             ++i)
            texts->push_back(names.next());
    }
    mesh.materials = child.get<SurfaceMaterial>();
    for (const glm::ivec2& size : child.get<glm::ivec2>())
        mesh.images.push_back({size.x, size.y, 4, {}});
    for (Image& image : mesh.images)
        image.pixels = child.get<uint8_t>();
    checkWhole(mesh, location);
    return mesh;
}

}  // namespace

Mesh loadMesh(const std::string& file) {
    const FileReader readable(file);  // says what is no file, or cannot be opened
    const bool trusted = !environment("SHOAL_TRUST_MODELS").empty();
    Mesh mesh = trusted ? readModel(file, [](uint64_t) {}) : readConfined(file);
    completeMesh(mesh);
    return mesh;
}

}  // namespace shoal
