#include "geometry/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "geometry/classic_material.h"
#include "geometry/model_images.h"

namespace shoal {

namespace {

class GltfMaterialReader {
  public:
    GltfMaterialReader(GltfFile& file, const ModelFile& model, Mesh& mesh)
        : file_(file), mesh_(mesh), images_(model, mesh.images) {}

    GltfCoordinates read(int number) {
        JsonReader material = file_.item("materials", number);
        name_.clear();
        material.get("name", name_);
        coordinates_.reset();
        SurfaceMaterial out;
        if (std::optional<JsonReader> other = gltfExtension(material, "KHR_materials_pbrSpecularGlossiness"))
            readGlossy(*other, out);
        else
            readMetallic(material, out);
        out.normalImage = imageOf(material, "normalTexture", "normal");
        if (std::optional<JsonReader> normal = material.object("normalTexture"))
            normal->get("scale", out.normalScale);
        readEmissive(material, out);
        readAlpha(material, out);
        readRefraction(material, out);
        if (material.has("occlusionTexture")) note("its images of occlusion are not drawn");
        mesh_.materials.push_back(out);
        return coordinates_.value_or(GltfCoordinates{});
    }

  private:
    void note(const std::string& what) { mesh_.notes.push_back(concat("material \"", name_, "\": ", what)); }

    static double share(JsonReader& from, const char* key, double usual) {
        from.get(key, usual);
        return std::clamp(usual, 0.0, 1.0);
    }
    static glm::dvec4 color(JsonReader& from, const char* key) {
        glm::dvec4 out(1);
        from.get(key, out);
        return glm::clamp(out, 0.0, 1.0);
    }

    void readMetallic(JsonReader& material, SurfaceMaterial& out) {
        out.metallic = out.roughness = 1;
        std::optional<JsonReader> surface = material.object("pbrMetallicRoughness");
        if (!surface) return;
        out.colorImage = imageOf(*surface, "baseColorTexture", "colour");
        out.color = color(*surface, "baseColorFactor");
        out.metallic = share(*surface, "metallicFactor", 1);
        out.roughness = share(*surface, "roughnessFactor", 1);
        out.roughnessImage = imageOf(*surface, "metallicRoughnessTexture", "roughness");
    }

    void readGlossy(JsonReader& surface, SurfaceMaterial& out) {
        out.colorImage = imageOf(surface, "diffuseTexture", "colour");
        out.color = color(surface, "diffuseFactor");
        out.roughness = 1 - share(surface, "glossinessFactor", 1);
        if (surface.has("specularGlossinessTexture")) note("its images of specular are not drawn");
    }

    // The factor counts: where it is black, the image shows nothing.
    void readEmissive(JsonReader& material, SurfaceMaterial& out) {
        material.get("emissiveFactor", out.emissive);
        double strength = 1;
        if (auto more = gltfExtension(material, "KHR_materials_emissive_strength"))
            more->get("emissiveStrength", strength);
        constexpr double brightest = 1e6;
        out.emissive = glm::clamp(out.emissive * strength, 0.0, brightest);
        if (out.emissive != glm::dvec3(0))
            out.emissiveImage = imageOf(material, "emissiveTexture", "emissive");
    }

    void readAlpha(JsonReader& material, SurfaceMaterial& out) {
        int mode = 0;
        material.choose("alphaMode", {"OPAQUE", "MASK", "BLEND"}, mode);
        out.alpha = SurfaceMaterial::Alpha(mode);
        out.alphaCut = share(material, "alphaCutoff", 0.5);
        if (out.alpha == SurfaceMaterial::Alpha::opaque) out.color.a = 1;
    }

    // Glass is blended, and as dense as glass unless the file says otherwise.
    void readRefraction(JsonReader& material, SurfaceMaterial& out) {
        if (auto glass = gltfExtension(material, "KHR_materials_transmission")) {
            if (glass->has("transmissionTexture")) note("its images of transmission are not drawn");
            if (const double through = share(*glass, "transmissionFactor", 0); through > 0) {
                out.alpha = SurfaceMaterial::Alpha::blend;
                out.color.a *= 1 - through;
                out.refraction = 1.5;
            }
        }
        double index = 1;
        if (auto ior = gltfExtension(material, "KHR_materials_ior")) index = 1.5, ior->get("ior", index);
        setRefraction(out, index);
    }

    // The coordinates of an image, after KHR_texture_transform.
    static GltfCoordinates coordinatesOf(JsonReader& texture) {
        GltfCoordinates out;
        const Range sets = Range::between(0, 100);
        texture.get("texCoord", out.set, sets);
        if (auto transform = gltfExtension(texture, "KHR_texture_transform")) {
            glm::dvec2 offset(0), scale(1);
            double rotation = 0;
            const Range range = Range::between(-1e6, 1e6);
            transform->get("offset", offset, range);
            transform->get("scale", scale, range);
            transform->get("rotation", rotation, range);
            transform->get("texCoord", out.set, sets);
            const double c = std::cos(rotation), s = std::sin(rotation);
            out.transform = out.transform * glm::dmat3(c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y,
                                                       0, offset.x, offset.y, 1);
        }
        return out;
    }

    // The number of an image; -1: there is none, or it cannot be read.
    int imageOf(JsonReader& object, const char* key, const char* what) {
        std::optional<JsonReader> texture = object.object(key);
        if (!texture) return -1;
        const GltfCoordinates own = coordinatesOf(*texture);
        if (!coordinates_) coordinates_ = own;
        if (own.set != coordinates_->set)
            note(concat("its ", what, " image lies by set ", coordinates_->set,
                        " of its texture coordinates, where the first lies, not by set ", own.set));
        else if (own.transform != coordinates_->transform)
            note(concat("its ", what, " image lies as its first, not by its own KHR_texture_transform"));
        texture->require("index");
        JsonReader source = file_.item("textures", file_.index(*texture, "index", "textures"));
        const auto told = [&](const std::string& why) {
            note(concat("its ", what, " image is left out: ", why));
        };
        const int image = file_.index(source, "source", "images");
        if (image >= 0) return load(image, told);
        told("it is of none of the formats that are read");
        return -1;
    }

    int load(int number, const ModelImages::Told& told) {
        JsonReader image = file_.item("images", number);
        const std::string key = concat("$.images[", number, "]");
        std::string uri;
        if (!image.get("uri", uri)) {
            image.require("bufferView");
            const std::span<const uint8_t> bytes =
                file_.bytes(file_.index(image, "bufferView", "bufferViews"));
            return images_.kept(
                key, [&] { return images_.decoded(std::string(bytes.begin(), bytes.end()), key); }, told);
        }
        if (!uri.starts_with("data:")) return images_.fromFile(percentDecoded(uri), told);
        return images_.kept(
            key, [&] { return images_.decoded(file_.fetch(uri, image.locate("uri")), key); }, told);
    }

    GltfFile& file_;
    Mesh& mesh_;
    ModelImages images_;
    std::string name_;
    std::optional<GltfCoordinates> coordinates_;
};

}  // namespace

std::vector<GltfCoordinates> readGltfMaterials(GltfFile& file, const ModelFile& model, Mesh& mesh) {
    GltfMaterialReader reader(file, model, mesh);
    std::vector<GltfCoordinates> out;
    for (size_t i = 0; i < file.count("materials"); ++i)
        out.push_back(reader.read(int(i)));
    return out;
}

}  // namespace shoal
