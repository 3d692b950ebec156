// "particle" of a group: a type of point particle (scene/particle.h).
#include <initializer_list>

#include "core/image.h"
#include "scene/json/reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<ParticleType> auto& type) {
    v.number("mass", type.mass, Range::between(leastParticleMass, mostParticleMass));
    v.word("shape", type.shape, {"points", "sprites", "quads"});
    v.number("pixels", type.pixels, Range::between(1, mostParticlePixels));
    v.word("facing", type.facing, {"camera", "velocity", "free"});
    v.span("size", type.size, Range::between(leastParticleSize, mostParticleSize));
    v.span("turn", type.turn, Range::between(-mostParticleTurn, mostParticleTurn));
    v.span("spin", type.spin, Range::between(-mostParticleTurn, mostParticleTurn));
    v.number("stretch", type.stretch, Range::between(0, mostParticleSize));
    v.word("blend", type.blend, {"none", "alpha", "additive", "multiplicative"});
    v.word("sort", type.sort, {"none", "frame", "spread"});
    v.number("spreadFrames", type.spreadFrames, Range::between(1, mostSpreadFrames));
    v.number("softness", type.softness, Range::between(0, mostParticleSize));
    v.flag("lit", type.lit);
}

template <typename V>
static void members(V&& v, Either<ColorKey> auto& key) {
    v.number("age", key.age, Range::between(0, 1));
    v.number("color", key.color, Range::between(0, mostParticleColor));
    v.number("opacity", key.opacity, Range::between(0, 1));
}

template <typename V>
static void members(V&& v, Either<ParticleImage> auto& image) {
    v.number("columns", image.columns, Range::between(1, mostTiles));
    v.number("rows", image.rows, Range::between(1, mostTiles));
    v.flag("flipBook", image.flipBook);
    v.number("frameRate", image.frameRate, Range::between(0, mostFrameRate));
    v.flag("blend", image.blend);
}

namespace {

const Range growths = Range::between(0, mostParticleSize);

void checkKeyCount(size_t count, const Where& where) {
    if (count == 0) throw Error(where.at("colors"), "expected at least one keyframe, found none");
    if (count > mostColorKeys)
        throw Error(where.at("colors"),
                    concat("expected at most ", mostColorKeys, " keyframes, found ", count));
}

void checkAge(double age, double before, const Where& where) {
    if (age - before < leastPositive)
        throw Error(where.at("age"),
                    concat("expected an age above that of the keyframe before, ", before, ", found ", age));
}

void checkTiles(const ParticleImage& image, const Where& where, const char* key) {
    const int most = image.columns * image.rows - 1;
    for (const int tile : {image.firstTile, image.lastTile})
        if (tile < 0 || tile > most)
            throw Error(where.at(key), concat("the image has tiles 0 to ", most, ", found ", tile));
    if (image.firstTile > image.lastTile)
        throw Error(where.at(key),
                    concat("expected [first, last], found ", image.firstTile, " above ", image.lastTile));
}

void checkFlipBook(const ParticleImage& image, const Where& where) {
    if (image.flipBook && image.firstTile == image.lastTile)
        throw Error(where.at("flipBook"), "a flip-book needs at least two tiles");
}

void checkGrowth(const glm::dvec2& growth, const Where& where) {
    if (growth == glm::dvec2(0))
        throw Error(where.at("growth"), "expected a factor above 0 at birth or at the end, found 0 for both");
}

// A key that is there though it means nothing. `because` goes on from its name.
void refuse(const JsonReader& r, std::initializer_list<const char*> keys, const char* because) {
    for (const char* key : keys)
        if (r.has(key)) throw Error(r.at(key), concat("\"", key, "\" ", because));
}

std::vector<ColorKey> readColors(JsonReader& r) {
    std::vector<JsonReader> entries = r.objects("colors");
    checkKeyCount(entries.size(), r);
    std::vector<ColorKey> out;
    for (JsonReader& entry : entries) {
        if (!out.empty()) entry.require("age");
        const auto key = readMembers<ColorKey>(entry);
        if (!out.empty()) checkAge(key.age, out.back().age, entry);
        entry.finish();
        out.push_back(key);
    }
    return out;
}

void readTiles(JsonReader& r, ParticleImage& image) {
    image.lastTile = image.columns * image.rows - 1;
    if (r.get("tile", image.firstTile)) {
        refuse(r, {"tiles"}, "is given besides \"tile\": one of the two");
        image.lastTile = image.firstTile;
        checkTiles(image, r, "tile");
    }
    std::vector<int> ends;
    if (!r.get("tiles", ends)) return;
    if (ends.size() != 2)
        throw Error(r.at("tiles"), concat("expected [first, last], found ", ends.size(), " numbers"));
    image.firstTile = ends[0];
    image.lastTile = ends[1];
    checkTiles(image, r, "tiles");
}

ParticleImage readImage(JsonReader& r) {
    ParticleImage image;
    image.file = needFile(r, "file");
    members(ReadScene(r), image);
    readTiles(r, image);
    if (!image.flipBook) refuse(r, {"frameRate", "blend"}, "is of flip-books: \"flipBook\" is not true");
    checkFlipBook(image, r);
    r.finish();

    const Image pixels = readPng(image.file);
    if (pixels.width % image.columns != 0 || pixels.height % image.rows != 0)
        throw Error(r.at("file"),
                    concat("the image is ", pixels.width, " x ", pixels.height, " pixels, which ",
                           image.columns, " x ", image.rows, " tiles of the same size do not fill"));
    return image;
}

// Keys that have no effect beside the others.
void refuseIdle(const JsonReader& r, const ParticleType& type) {
    if (type.shape != ParticleShape::quads)
        refuse(r, {"facing", "stretch"}, "is of the shape quads: the others face the camera");
    if (type.shape == ParticleShape::points)
        refuse(r, {"size", "growth", "turn", "spin", "image"},
               "does not show on the shape points, round dots of a fixed number of \"pixels\"");
    else
        refuse(r, {"pixels"}, "is of the shape points: others have a \"size\" in metres");
    if (type.facing == ParticleFacing::velocity)
        refuse(r, {"turn", "spin"}, "has no effect: facing velocity, a particle points where it goes");
    else
        refuse(r, {"stretch"}, "is of the facing velocity");
    if (type.blend != Blend::alpha)
        refuse(r, {"sort", "spreadFrames"}, "is of the blend alpha: the others need no order");
    if (type.sort != DrawSort::spread) refuse(r, {"spreadFrames"}, "is of the sort spread");
    if (type.blend == Blend::none)
        refuse(r, {"softness"}, "needs a blend: what is not blended does not fade");
    if (type.blend == Blend::multiplicative)
        refuse(r, {"lit"}, "has no effect: what is multiplied with what is behind sends no light");
}

// "growth": the factor at the end, or [at birth, at the end].
void readGrowth(JsonReader& r, glm::dvec2& growth) {
    const JsonValue* value = r.raw("growth");
    if (value && value->kind == JsonValue::Kind::number)
        r.get("growth", growth.y, growths);
    else
        r.get("growth", growth, growths);
    checkGrowth(growth, r);
}

}  // namespace

ParticleType readParticleType(JsonReader& r) {
    ParticleType type;
    members(ReadScene(r), type);
    refuseIdle(r, type);
    readGrowth(r, type.growth);
    if (r.has("colors")) type.colors = readColors(r);
    if (auto image = r.object("image")) type.image = readImage(*image);
    r.raw("colors");  // known even when absent
    r.finish();
    return type;
}

void checkParticle(const ParticleType& type, const Where& where) {
    members(CheckScene(where), type);
    CheckScene(where).number("growth", type.growth, growths);
    checkGrowth(type.growth, where);
    checkKeyCount(type.colors.size(), where);
    for (size_t i = 0; i < type.colors.size(); ++i) {
        const Where key = where.in("colors", i);
        members(CheckScene(key), type.colors[i]);
        if (i > 0) checkAge(type.colors[i].age, type.colors[i - 1].age, key);
    }
    if (!type.image) return;
    const Where image = where.in("image");
    members(CheckScene(image), *type.image);
    checkTiles(*type.image, image, "tiles");
    checkFlipBook(*type.image, image);
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
