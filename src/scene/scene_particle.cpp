// "particle" of a group: a type of point particle (scene/particle.h).
#include <initializer_list>

#include "core/image.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

// A key that is there though it means nothing. `because` goes on from its name.
void refuse(const JsonReader& r, std::initializer_list<const char*> keys, const char* because) {
    for (const char* key : keys)
        if (r.has(key)) throw Error(r.at(key), concat("\"", key, "\" ", because));
}

std::vector<ColorKey> readColors(JsonReader& r) {
    std::vector<JsonReader> entries = r.objects("colors");
    if (entries.empty()) throw Error(r.at("colors"), "expected at least one keyframe, found none");
    if (entries.size() > mostColorKeys)
        throw Error(r.at("colors"),
                    concat("expected at most ", mostColorKeys, " keyframes, found ", entries.size()));
    std::vector<ColorKey> out;
    for (JsonReader& entry : entries) {
        ColorKey key;
        if (!out.empty()) entry.require("age");
        entry.get("age", key.age, Range::between(0, 1));
        if (!out.empty() && key.age - out.back().age < leastPositive)
            throw Error(entry.at("age"), concat("expected an age above that of the keyframe before, ",
                                                out.back().age, ", found ", key.age));
        entry.get("color", key.color, Range::between(0, mostParticleColor));
        entry.get("opacity", key.opacity, Range::between(0, 1));
        entry.finish();
        out.push_back(key);
    }
    return out;
}

void readTiles(JsonReader& r, ParticleImage& image) {
    const int most = image.columns * image.rows - 1;
    const std::string held = concat("the image has tiles 0 to ", most);
    image.lastTile = most;
    if (r.get("tile", image.firstTile)) {
        refuse(r, {"tiles"}, "is given besides \"tile\": one of the two");
        image.lastTile = image.firstTile;
        if (image.firstTile < 0 || image.firstTile > most)
            throw Error(r.at("tile"), concat(held, ", found ", image.firstTile));
    }
    std::vector<int> ends;
    if (!r.get("tiles", ends)) return;
    if (ends.size() != 2)
        throw Error(r.at("tiles"), concat("expected [first, last], found ", ends.size(), " numbers"));
    for (const int tile : ends)
        if (tile < 0 || tile > most) throw Error(r.at("tiles"), concat(held, ", found ", tile));
    if (ends[0] > ends[1])
        throw Error(r.at("tiles"), concat("expected [first, last], found ", ends[0], " above ", ends[1]));
    image.firstTile = ends[0];
    image.lastTile = ends[1];
}

ParticleImage readImage(JsonReader& r) {
    ParticleImage image;
    image.file = needFile(r, "file");
    r.get("columns", image.columns, Range::between(1, mostTiles));
    r.get("rows", image.rows, Range::between(1, mostTiles));
    readTiles(r, image);
    r.get("flipBook", image.flipBook);
    if (!image.flipBook) refuse(r, {"frameRate", "blend"}, "is of flip-books: \"flipBook\" is not true");
    if (image.flipBook && image.firstTile == image.lastTile)
        throw Error(r.at("flipBook"), "a flip-book needs at least two tiles");
    r.get("frameRate", image.frameRate, Range::between(0, mostFrameRate));
    r.get("blend", image.blend);
    r.finish();

    const Image pixels = readPng(image.file);
    if (pixels.width % image.columns != 0 || pixels.height % image.rows != 0)
        throw Error(r.at("file"),
                    concat("the image is ", pixels.width, " x ", pixels.height, " pixels, which ",
                           image.columns, " x ", image.rows, " tiles of the same size do not fill"));
    return image;
}

void readShape(JsonReader& r, ParticleType& type) {
    int shape = int(type.shape), facing = int(type.facing);
    r.choose("shape", {"points", "sprites", "quads"}, shape);
    type.shape = ParticleShape(shape);
    if (type.shape != ParticleShape::quads)
        refuse(r, {"facing", "stretch"}, "is of the shape quads: the others face the camera");
    if (type.shape == ParticleShape::points)
        refuse(r, {"size", "growth", "turn", "spin", "image"},
               "does not show on the shape points, round dots of a fixed number of \"pixels\"");
    else
        refuse(r, {"pixels"}, "is of the shape points: others have a \"size\" in metres");
    r.get("pixels", type.pixels, Range::between(1, mostParticlePixels));

    r.choose("facing", {"camera", "velocity", "free"}, facing);
    type.facing = ParticleFacing(facing);
    if (type.facing == ParticleFacing::velocity)
        refuse(r, {"turn", "spin"}, "has no effect: facing velocity, a particle points where it goes");
    else
        refuse(r, {"stretch"}, "is of the facing velocity");

    getSpan(r, "size", type.size, Range::between(leastParticleSize, mostParticleSize));
    getSpan(r, "turn", type.turn, Range::between(-mostParticleTurn, mostParticleTurn));
    getSpan(r, "spin", type.spin, Range::between(-mostParticleTurn, mostParticleTurn));
    r.get("stretch", type.stretch, Range::between(0, mostParticleSize));
}

// "growth": the factor at the end, or [at birth, at the end].
void readGrowth(JsonReader& r, glm::dvec2& growth) {
    const Range range = Range::between(0, mostParticleSize);
    const JsonValue* value = r.raw("growth");
    if (value && value->kind == JsonValue::Kind::number)
        r.get("growth", growth.y, range);
    else
        r.get("growth", growth, range);
    if (growth == glm::dvec2(0))
        throw Error(r.at("growth"), "expected a factor above 0 at birth or at the end, found 0 for both");
}

void readBlend(JsonReader& r, ParticleType& type) {
    int blend = int(type.blend), sort = int(type.sort);
    r.choose("blend", {"none", "alpha", "additive", "multiplicative"}, blend);
    type.blend = Blend(blend);
    if (type.blend != Blend::alpha)
        refuse(r, {"sort", "spreadFrames"}, "is of the blend alpha: the others need no order");
    r.choose("sort", {"none", "frame", "spread"}, sort);
    type.sort = DrawSort(sort);
    if (type.sort != DrawSort::spread) refuse(r, {"spreadFrames"}, "is of the sort spread");
    r.get("spreadFrames", type.spreadFrames, Range::between(1, mostSpreadFrames));

    if (type.blend == Blend::none)
        refuse(r, {"softness"}, "needs a blend: what is not blended does not fade");
    r.get("softness", type.softness, Range::between(0, mostParticleSize));
    if (type.blend == Blend::multiplicative)
        refuse(r, {"lit"}, "has no effect: what is multiplied with what is behind sends no light");
    r.get("lit", type.lit);
}

}  // namespace

ParticleType readParticleType(JsonReader& r) {
    ParticleType type;
    r.get("mass", type.mass, Range::between(leastParticleMass, mostParticleMass));
    readShape(r, type);
    readGrowth(r, type.growth);
    if (r.has("colors")) type.colors = readColors(r);
    if (auto image = r.object("image")) type.image = readImage(*image);
    readBlend(r, type);
    r.raw("colors");  // known even when absent
    r.finish();
    return type;
}

std::vector<Warning> agelessWarnings(const ParticleType& type, const Location& where) {
    std::vector<Warning> out;
    const auto warn = [&](bool given, const char* what) {
        if (given) out.push_back({where, concat("these particles live for ever: ", what)});
    };
    warn(type.colors.size() > 1, "only the first colour shows");
    warn(type.growth.x != type.growth.y, "they do not grow or shrink with age");
    warn(type.image && type.image->flipBook && type.image->frameRate == 0,
         "only the first frame of the flip-book shows, which needs a frameRate");
    return out;
}

}  // namespace shoal
