#include "exchange/gltf.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <glm/gtc/quaternion.hpp>

#include "core/error.h"
#include "core/json_build.h"

namespace shoal::exchange {

namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are little-endian");

constexpr int floats = 5126, words = 5125;  // component types
constexpr int vertexTarget = 34962, indexTarget = 34963;
constexpr int pointsMode = 0, trianglesMode = 4;

class Glb {
  public:
    std::vector<std::byte> encode(const std::vector<DrawnMesh>& meshes, const std::optional<Camera>& camera) {
        for (const DrawnMesh& mesh : meshes)
            if (!mesh.positions.empty()) add(mesh);
        if (camera) add(*camera);
        JsonValue root = object(key("asset", object(key("version", "2.0"), key("generator", "shoal"))),
                                key("scene", 0), key("scenes", JsonValue::makeArray()));
        root.members.back().second.items.push_back(object(key("nodes", nodeNumbers_)));
        const auto list = [&](const char* name, std::vector<JsonValue>& items) {
            if (!items.empty()) append(root, key(name, items));
        };
        list("nodes", nodes_);
        list("meshes", meshes_);
        list("materials", materials_);
        list("textures", textures_);
        list("images", images_);
        list("cameras", cameras_);
        list("accessors", accessors_);
        list("bufferViews", views_);
        if (!bytes_.empty()) {
            std::vector<JsonValue> buffers = {object(key("byteLength", bytes_.size()))};
            append(root, key("buffers", buffers));
        }
        return file(writeJson(root));
    }

  private:
    int add(const void* data, size_t bytes, std::optional<int> target) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        JsonValue view = object(key("buffer", 0), key("byteOffset", bytes_.size()), key("byteLength", bytes));
        if (target) append(view, key("target", *target));
        views_.push_back(std::move(view));
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + bytes);
        return int(views_.size()) - 1;
    }

    template <typename T>
    int accessor(const std::vector<T>& values, const char* type, int component, int target) {
        const int view = add(values.data(), values.size() * sizeof(T), target);
        accessors_.push_back(object(key("bufferView", view), key("componentType", component),
                                    key("count", values.size()), key("type", type)));
        return int(accessors_.size()) - 1;
    }

    int positions(const std::vector<glm::vec3>& values) {
        const int index = accessor(values, "VEC3", floats, vertexTarget);
        glm::vec3 low(values[0]), high(values[0]);
        for (const glm::vec3& p : values)
            low = glm::min(low, p), high = glm::max(high, p);
        append(accessors_.back(), key("min", glm::dvec3(low)), key("max", glm::dvec3(high)));
        return index;
    }

    int texture(const DrawnMesh& mesh, int image) {
        const std::vector<std::byte> png = encodePng(mesh.images[size_t(image)]);
        images_.push_back(
            object(key("bufferView", add(png.data(), png.size(), {})), key("mimeType", "image/png")));
        textures_.push_back(object(key("source", images_.size() - 1)));
        return int(textures_.size()) - 1;
    }

    int material(const DrawnMesh& mesh, const SurfaceMaterial& looks) {
        JsonValue pbr =
            object(key("baseColorFactor",
                       std::vector<double>{looks.color.r, looks.color.g, looks.color.b, looks.color.a}),
                   key("metallicFactor", looks.metallic), key("roughnessFactor", looks.roughness));
        const auto image = [&](int number) { return object(key("index", texture(mesh, number))); };
        if (looks.colorImage >= 0) append(pbr, key("baseColorTexture", image(looks.colorImage)));
        if (looks.roughnessImage >= 0)
            append(pbr, key("metallicRoughnessTexture", image(looks.roughnessImage)));
        JsonValue out = object(key("pbrMetallicRoughness", pbr), key("doubleSided", true));
        if (looks.normalImage >= 0) {
            JsonValue normal = image(looks.normalImage);
            append(normal, key("scale", looks.normalScale));
            append(out, key("normalTexture", normal));
        }
        if (looks.emissive != glm::dvec3(0))
            append(out, key("emissiveFactor", glm::min(looks.emissive, 1.0)));
        if (looks.emissiveImage >= 0) append(out, key("emissiveTexture", image(looks.emissiveImage)));
        if (looks.alpha == SurfaceMaterial::Alpha::cut)
            append(out, key("alphaMode", "MASK"), key("alphaCutoff", looks.alphaCut));
        if (looks.alpha == SurfaceMaterial::Alpha::blend) append(out, key("alphaMode", "BLEND"));
        materials_.push_back(std::move(out));
        return int(materials_.size()) - 1;
    }

    void add(const DrawnMesh& mesh) {
        JsonValue attributes = object(key("POSITION", positions(mesh.positions)));
        // Only where all have one: glTF asks for unit length.
        const auto isUnit = [](const glm::vec3& n) { return std::abs(glm::length(n) - 1) < 1e-3f; };
        const auto vertices = [&](const char* name, const auto& values, const char* type) {
            if (!values.empty()) append(attributes, key(name, accessor(values, type, floats, vertexTarget)));
        };
        if (std::all_of(mesh.normals.begin(), mesh.normals.end(), isUnit))
            vertices("NORMAL", mesh.normals, "VEC3");
        std::vector<glm::vec2> uvs;
        for (const glm::vec2& uv : mesh.uvs)
            uvs.emplace_back(uv.x, 1 - uv.y);
        vertices("TEXCOORD_0", uvs, "VEC2");
        vertices("TEXCOORD_1", mesh.columns, "VEC2");
        std::vector<glm::vec4> blended;
        for (size_t i = 0; i < mesh.opacities.size(); ++i)
            blended.emplace_back(mesh.colors[i], mesh.opacities[i]);
        vertices("COLOR_0", blended, "VEC4");
        if (blended.empty()) vertices("COLOR_0", mesh.colors, "VEC3");
        vertices("_SIZE", mesh.sizes, "SCALAR");
        std::vector<JsonValue> primitives;
        for (const DrawnMesh::Piece& piece : mesh.pieces) {
            JsonValue primitive =
                object(key("attributes", attributes), key("material", material(mesh, piece.material)));
            if (mesh.corners.empty()) {
                append(primitive, key("mode", pointsMode));
            } else {
                const std::vector<uint32_t> corners(
                    mesh.corners.begin() + std::ptrdiff_t(piece.first),
                    mesh.corners.begin() + std::ptrdiff_t(piece.first + piece.count));
                append(primitive, key("mode", trianglesMode),
                       key("indices", accessor(corners, "SCALAR", words, indexTarget)));
            }
            primitives.push_back(std::move(primitive));
        }
        meshes_.push_back(object(key("name", mesh.name), key("primitives", primitives)));
        JsonValue node = object(key("name", mesh.name), key("mesh", meshes_.size() - 1));
        if (mesh.origin != glm::dvec3(0)) append(node, key("translation", mesh.origin));
        addNode(std::move(node));
    }

    void add(const Camera& camera) {
        cameras_.push_back(
            object(key("type", "perspective"),
                   key("perspective", object(key("yfov", camera.fieldOfView), key("znear", 0.01)))));
        const glm::dquat turn = glm::quat_cast(directionsOf(camera));
        addNode(object(key("name", "camera"), key("camera", 0), key("translation", camera.eye),
                       key("rotation", std::vector<double>{turn.x, turn.y, turn.z, turn.w})));
    }

    void addNode(JsonValue node) {
        nodes_.push_back(std::move(node));
        nodeNumbers_.push_back(int(nodes_.size()) - 1);
    }

    // Twelve bytes, then the JSON and the numbers, each with its length and kind.
    std::vector<std::byte> file(std::string json) {
        json.resize((json.size() + 3) / 4 * 4, ' ');
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        const size_t length = 12 + 8 + json.size() + (bytes_.empty() ? 0 : 8 + bytes_.size());
        if (length > UINT32_MAX)
            throw Error("a .glb file holds 4 GiB, and this one would take ", length, " bytes");
        std::vector<std::byte> out;
        out.reserve(length);
        const auto word = [&](uint32_t value) {
            const auto* first = reinterpret_cast<const std::byte*>(&value);
            out.insert(out.end(), first, first + 4);
        };
        constexpr uint32_t magic = 0x46546c67, jsonKind = 0x4e4f534a, binaryKind = 0x004e4942;
        for (const uint32_t value : {magic, 2u, uint32_t(length), uint32_t(json.size()), jsonKind})
            word(value);
        const auto* text = reinterpret_cast<const std::byte*>(json.data());
        out.insert(out.end(), text, text + json.size());
        if (bytes_.empty()) return out;
        word(uint32_t(bytes_.size()));
        word(binaryKind);
        out.insert(out.end(), bytes_.begin(), bytes_.end());
        return out;
    }

    std::vector<std::byte> bytes_;
    std::vector<JsonValue> nodes_, meshes_, materials_, textures_, images_, cameras_, accessors_, views_;
    std::vector<int> nodeNumbers_;
};

}  // namespace

std::vector<std::byte> encodeGlb(const std::vector<DrawnMesh>& meshes, const std::optional<Camera>& camera) {
    return Glb().encode(meshes, camera);
}

}  // namespace shoal::exchange
