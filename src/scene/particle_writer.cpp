#include "scene/particle_writer.h"

#include <filesystem>

namespace shoal {

namespace {

namespace fs = std::filesystem;

// Writes keys into an object.
class Keys {
  public:
    JsonValue object = JsonValue::makeObject();

    void number(const char* key, double value, double unless) {
        if (value != unless) object.add(key, JsonValue::makeNumber(value));
    }
    void flag(const char* key, bool value, bool unless) {
        if (value != unless) object.add(key, JsonValue::makeBoolean(value));
    }
    void word(const char* key, const char* value, bool unless) {
        if (!unless) object.add(key, JsonValue::makeString(value));
    }
    void vector(const char* key, const glm::dvec3& value, const glm::dvec3& unless) {
        if (value != unless) object.add(key, JsonValue::makeVector(value));
    }
    // As getSpan reads it.
    void span(const char* key, const glm::dvec2& value, const glm::dvec2& unless) {
        if (value == unless) return;
        object.add(key, value.x == value.y ? JsonValue::makeNumber(value.x) : JsonValue::makeVector(value));
    }
};

std::string relativeTo(const std::string& sceneFile, const std::string& file) {
    const fs::path folder = fs::path(sceneFile).parent_path();
    if (folder.empty()) return file;
    const fs::path relative = fs::absolute(file).lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() ? file : relative.generic_string();
}

JsonValue write(const std::vector<ColorKey>& colors) {
    JsonValue out = JsonValue::makeArray();
    for (const ColorKey& color : colors) {
        Keys keys;
        if (!out.items.empty() || color.age != 0) keys.object.add("age", JsonValue::makeNumber(color.age));
        keys.vector("color", color.color, ColorKey().color);
        keys.number("opacity", color.opacity, ColorKey().opacity);
        out.items.push_back(std::move(keys.object));
    }
    return out;
}

JsonValue write(const ParticleImage& image, const std::string& sceneFile) {
    Keys keys;
    keys.object.add("file", JsonValue::makeString(relativeTo(sceneFile, image.file)));
    keys.number("columns", image.columns, 1);
    keys.number("rows", image.rows, 1);
    if (image.firstTile == image.lastTile)
        keys.number("tile", image.firstTile, image.columns * image.rows == 1 ? 0 : -1);
    else if (image.firstTile != 0 || image.lastTile != image.columns * image.rows - 1)
        keys.object.add("tiles", JsonValue::makeVector(glm::ivec2(image.firstTile, image.lastTile)));
    if (!image.flipBook) return std::move(keys.object);
    keys.flag("flipBook", true, false);
    keys.number("frameRate", image.frameRate, 0);
    keys.flag("blend", image.blend, true);
    return std::move(keys.object);
}

bool isWhite(const std::vector<ColorKey>& colors) {
    return colors.size() == 1 && colors[0].age == 0 && colors[0].color == glm::dvec3(1) &&
           colors[0].opacity == 1;
}

void writeShape(Keys& keys, const ParticleType& type) {
    const ParticleType usual;
    keys.word("shape", name(type.shape), type.shape == usual.shape);
    if (type.shape == ParticleShape::points) return keys.number("pixels", type.pixels, usual.pixels);
    keys.span("size", type.size, usual.size);
    if (type.growth.x == 1)
        keys.number("growth", type.growth.y, 1);
    else
        keys.object.add("growth", JsonValue::makeVector(type.growth));
    const bool quads = type.shape == ParticleShape::quads;
    if (quads) keys.word("facing", name(type.facing), type.facing == usual.facing);
    if (quads && type.facing == ParticleFacing::velocity)
        return keys.number("stretch", type.stretch, usual.stretch);
    keys.span("turn", type.turn, usual.turn);
    keys.span("spin", type.spin, usual.spin);
}

}  // namespace

JsonValue writeParticle(const ParticleType& type, const std::string& sceneFile) {
    const ParticleType usual;
    Keys keys;
    keys.number("mass", type.mass, usual.mass);
    writeShape(keys, type);
    if (!isWhite(type.colors)) keys.object.add("colors", write(type.colors));
    if (type.image && type.shape != ParticleShape::points)
        keys.object.add("image", write(*type.image, sceneFile));
    keys.word("blend", name(type.blend), type.blend == usual.blend);
    if (type.blend == Blend::alpha) {
        keys.word("sort", name(type.sort), type.sort == usual.sort);
        if (type.sort == DrawSort::spread) keys.number("spreadFrames", type.spreadFrames, usual.spreadFrames);
    }
    if (type.blend != Blend::none) keys.number("softness", type.softness, usual.softness);
    if (type.blend != Blend::multiplicative) keys.flag("lit", type.lit, usual.lit);
    return std::move(keys.object);
}

}  // namespace shoal
