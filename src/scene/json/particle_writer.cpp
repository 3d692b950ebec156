#include "scene/json/particle_writer.h"

#include <filesystem>

#include "scene/json/key_writer.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;

std::string relativeTo(const std::string& sceneFile, const std::string& file) {
    const fs::path folder = fs::path(sceneFile).parent_path();
    if (folder.empty()) return file;
    const fs::path relative = fs::absolute(file).lexically_relative(fs::absolute(folder).lexically_normal());
    return relative.empty() ? file : relative.generic_string();
}

JsonValue write(const std::vector<ColorKey>& colors) {
    JsonValue out = JsonValue::makeArray();
    for (const ColorKey& color : colors) {
        KeyWriter keys;
        if (!out.items.empty() || color.age != 0) keys.object.add("age", JsonValue::makeNumber(color.age));
        keys.vector("color", color.color, ColorKey().color);
        keys.number("opacity", color.opacity, ColorKey().opacity);
        out.items.push_back(std::move(keys.object));
    }
    return out;
}

JsonValue write(const ParticleImage& image, const std::string& sceneFile) {
    KeyWriter keys;
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

void writeShape(KeyWriter& keys, const ParticleType& type) {
    const ParticleType usual;
    if (type.shape != usual.shape) keys.word("shape", name(type.shape));
    if (type.shape == ParticleShape::points) return keys.number("pixels", type.pixels, usual.pixels);
    keys.span("size", type.size, usual.size);
    if (type.growth.x == 1)
        keys.number("growth", type.growth.y, 1);
    else
        keys.object.add("growth", JsonValue::makeVector(type.growth));
    const bool quads = type.shape == ParticleShape::quads;
    if (quads)
        if (type.facing != usual.facing) keys.word("facing", name(type.facing));
    if (quads && type.facing == ParticleFacing::velocity)
        return keys.number("stretch", type.stretch, usual.stretch);
    keys.span("turn", type.turn, usual.turn);
    keys.span("spin", type.spin, usual.spin);
}

}  // namespace

JsonValue writeParticle(const ParticleType& type, const std::string& sceneFile) {
    const ParticleType usual;
    KeyWriter keys;
    keys.number("mass", type.mass, usual.mass);
    writeShape(keys, type);
    if (!isWhite(type.colors)) keys.object.add("colors", write(type.colors));
    if (type.image && type.shape != ParticleShape::points)
        keys.object.add("image", write(*type.image, sceneFile));
    if (type.blend != usual.blend) keys.word("blend", name(type.blend));
    if (type.blend == Blend::alpha) {
        if (type.sort != usual.sort) keys.word("sort", name(type.sort));
        if (type.sort == DrawSort::spread) keys.number("spreadFrames", type.spreadFrames, usual.spreadFrames);
    }
    if (type.blend != Blend::none) keys.number("softness", type.softness, usual.softness);
    if (type.blend != Blend::multiplicative) keys.flag("lit", type.lit, usual.lit);
    return std::move(keys.object);
}

}  // namespace shoal
