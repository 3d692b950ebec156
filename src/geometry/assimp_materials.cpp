#include "geometry/assimp_materials.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <assimp/scene.h>

#include "core/error.h"
#include "geometry/classic_material.h"
#include "geometry/mesh.h"
#include "geometry/model_images.h"
#include "geometry/model_reader.h"

namespace shoal {

namespace {

// The texels of an embedded image that the file holds as they are.
Image uncompressed(const aiTexture& texture) {
    Image out{int(texture.mWidth), int(texture.mHeight), 4, {}};
    if (out.width > maxImageSide || out.height > maxImageSide ||
        size_t(out.width) * size_t(out.height) > maxImageTexels)
        throw Error("is ", out.width, " x ", out.height, " texels large");
    for (size_t i = 0; i < size_t(out.width) * size_t(out.height); ++i) {
        const aiTexel& t = texture.pcData[i];
        out.pixels.insert(out.pixels.end(), {t.r, t.g, t.b, t.a});
    }
    return out;
}

class MaterialReader {
  public:
    MaterialReader(const aiScene& scene, const ModelFile& model, Mesh& mesh)
        : scene_(scene), mesh_(mesh), images_(model, mesh.images) {}

    void read(const aiMaterial& material) {
        material_ = &material;
        aiString name;
        material.Get(AI_MATKEY_NAME, name);
        name_ = name.C_Str();
        SurfaceMaterial out;
        // What Assimp puts in where the file has no material says nothing of the model.
        if (name_ != AI_DEFAULT_MATERIAL_NAME) {
            out.colorImage = imageOf("colour", {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
            readColor(out);
            readSurface(out);
            readAlpha(out);
            readRefraction(out);
            tellDropped();
        }
        mesh_.materials.push_back(out);
    }

  private:
    void note(const std::string& what) { mesh_.notes.push_back(concat("material \"", name_, "\": ", what)); }

    template <typename T, typename... Key>
    std::optional<T> get(Key... key) const {
        T value{};
        if (material_->Get(key..., value) != AI_SUCCESS) return std::nullopt;
        return value;
    }
    std::optional<double> number(const char* key, unsigned type, unsigned index) const {
        const std::optional<float> value = get<float>(key, type, index);
        if (!value || !std::isfinite(*value)) return std::nullopt;
        return double(*value);
    }
    std::optional<double> share(const char* key, unsigned type, unsigned index) const {
        const std::optional<double> value = number(key, type, index);
        if (!value) return std::nullopt;
        return std::clamp(*value, 0.0, 1.0);
    }
    std::optional<glm::dvec3> color(const char* key, unsigned type, unsigned index) const {
        const std::optional<aiColor4D> c = get<aiColor4D>(key, type, index);
        if (!c || !std::isfinite(c->r + c->g + c->b)) return std::nullopt;
        return glm::max(glm::dvec3(c->r, c->g, c->b), 0.0);
    }

    void readColor(SurfaceMaterial& out) {
        std::optional<glm::dvec3> base = color(AI_MATKEY_BASE_COLOR);
        if (!base) {
            base = color(AI_MATKEY_COLOR_DIFFUSE);
            // Exporters leave the factor of an image at black.
            if (base == glm::dvec3(0) && out.colorImage >= 0) base.reset();
        }
        out.color = glm::dvec4(glm::min(base.value_or(glm::dvec3(1)), 1.0), 1);
        out.emissive = color(AI_MATKEY_COLOR_EMISSIVE).value_or(glm::dvec3(0));
        out.emissiveImage = imageOf("emissive", {aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE});
        if (out.emissive == glm::dvec3(0) && out.emissiveImage >= 0) out.emissive = glm::dvec3(1);
    }

    void readSurface(SurfaceMaterial& out) {
        out.metallic = share(AI_MATKEY_METALLIC_FACTOR).value_or(0);
        if (const auto roughness = share(AI_MATKEY_ROUGHNESS_FACTOR)) {
            out.roughness = *roughness;
        } else if (const auto gloss = share(AI_MATKEY_GLOSSINESS_FACTOR)) {
            out.roughness = 1 - *gloss;
        } else if (const auto exponent = number(AI_MATKEY_SHININESS); exponent && *exponent > 0) {
            out.roughness = roughnessOfExponent(*exponent);
        }
        out.roughnessImage = imageOf("roughness", {aiTextureType_METALNESS, aiTextureType_DIFFUSE_ROUGHNESS});
        out.normalImage = imageOf("normal", {aiTextureType_NORMAL_CAMERA, aiTextureType_NORMALS});
    }

    // Glass is blended. A format that has transmission says no index with it; glTF's is 1.5 then.
    void readRefraction(SurfaceMaterial& out) {
        if (const double through = share(AI_MATKEY_TRANSMISSION_FACTOR).value_or(0); through > 0) {
            out.alpha = SurfaceMaterial::Alpha::blend;
            out.color.a *= 1 - through;
            out.refraction = 1.5;
        }
        setRefraction(out, number(AI_MATKEY_REFRACTI).value_or(1));
    }

    void readAlpha(SurfaceMaterial& out) {
        const double opacity = share(AI_MATKEY_OPACITY).value_or(1);
        const int mask = imageOf("opacity", {aiTextureType_OPACITY});
        setOpacity(out, opacity, mask, images_, mesh_.images, [&](const std::string& what) { note(what); });
    }

    void tellDropped() {
        DroppedImages dropped;
        const auto drop = [&](aiTextureType type, const char* kind) {
            if (material_->GetTextureCount(type) > 0) dropped.add(kind);
        };
        drop(aiTextureType_AMBIENT_OCCLUSION, "occlusion");
        drop(aiTextureType_LIGHTMAP, "occlusion");
        drop(aiTextureType_HEIGHT, "bumps");
        drop(aiTextureType_DISPLACEMENT, "displacement");
        drop(aiTextureType_SPECULAR, "specular");
        drop(aiTextureType_SHININESS, "shininess");
        drop(aiTextureType_REFLECTION, "reflection");
        drop(aiTextureType_CLEARCOAT, "clear coat");
        drop(aiTextureType_SHEEN, "sheen");
        drop(aiTextureType_TRANSMISSION, "transmission");
        if (!dropped.kinds.empty()) note(dropped.note());
    }

    // The number of the first image of one of these types; -1: there is none, or it cannot be read.
    int imageOf(const char* what, std::initializer_list<aiTextureType> types) {
        for (const aiTextureType type : types) {
            aiString path;
            unsigned uvs = 0;
            if (material_->GetTexture(type, 0, &path, nullptr, &uvs) != AI_SUCCESS) continue;
            if (const unsigned first = textureCoordinatesOf(*material_).set; uvs != first)
                note(concat("its ", what, " image lies by set ", first,
                            " of its texture coordinates, where the colour lies, not by set ", uvs));
            return load(path.C_Str(), what);
        }
        return -1;
    }

    // Reads what the file embeds itself; the rest lies in files.
    int load(const std::string& path, const char* what) {
        const auto told = [&](const std::string& why) {
            note(concat("its ", what, " image is left out: ", why));
        };
        const aiTexture* embedded = scene_.GetEmbeddedTexture(path.c_str());
        if (!embedded) return images_.fromFile(path, told);
        return images_.kept(
            path,
            [&] {
                if (embedded->mHeight > 0) return uncompressed(*embedded);
                const auto* bytes = reinterpret_cast<const char*>(embedded->pcData);
                return images_.decoded(std::string(bytes, embedded->mWidth),
                                       path.empty() ? "an image" : path);
            },
            told);
    }

    const aiScene& scene_;
    Mesh& mesh_;
    ModelImages images_;
    const aiMaterial* material_ = nullptr;
    std::string name_;
};

}  // namespace

TextureCoordinates textureCoordinatesOf(const aiMaterial& material) {
    TextureCoordinates out;
    for (unsigned i = 1; i <= AI_TEXTURE_TYPE_MAX; ++i) {  // those of colour come first
        const auto type = aiTextureType(i);
        aiString path;
        if (material.GetTexture(type, 0, &path, nullptr, &out.set) != AI_SUCCESS) continue;
        aiUVTransform moved;
        if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), moved) != AI_SUCCESS) break;
        const double c = std::cos(moved.mRotation), s = std::sin(moved.mRotation);
        const glm::dvec2 scale(moved.mScaling.x, moved.mScaling.y);
        const glm::dvec2 offset(moved.mTranslation.x, moved.mTranslation.y);
        out.transform =
            glm::dmat3(c * scale.x, s * scale.x, 0, -s * scale.y, c * scale.y, 0, offset.x, offset.y, 1);
        for (int column = 0; column < 3; ++column)
            if (!std::isfinite(glm::dot(out.transform[column], glm::dvec3(1)))) out.transform = glm::dmat3(1);
        break;
    }
    return out;
}

void readMaterials(const aiScene& scene, const ModelFile& model, Mesh& mesh) {
    MaterialReader reader(scene, model, mesh);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i)
        reader.read(*scene.mMaterials[i]);
}

}  // namespace shoal
