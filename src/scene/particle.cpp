#include "scene/particle.h"

#include <algorithm>
#include <filesystem>

#include "core/describe.h"
#include "core/image.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> shapeWords = {"points", "sprites", "quads"};
const std::vector<std::string> facingWords = {"camera", "velocity", "free"};

void checkAges(const ParticleType& type, const Where& where) {
    const size_t count = type.colors.size();
    if (count == 0) throw Error(where.locate("colors"), "expected at least one keyframe, found none");
    if (count > mostColorKeys)
        throw Error(where.locate("colors"), "expected at most ", mostColorKeys, " keyframes, found ", count);
    for (size_t i = 1; i < count; ++i) {
        const Where here = where.in("colors", i);
        here.require("age");
        const double age = type.colors[i].age, before = type.colors[i - 1].age;
        if (age - before < leastPositive)
            throw Error(here.locate("age"), "expected an age above that of the keyframe before, ", before,
                        ", found ", age);
    }
}

void checkType(const ParticleType& type, const Where& where) {
    if (type.growth == glm::dvec2(0))
        throw Error(where.locate("growth"),
                    "expected a factor above 0 at birth or at the end, found 0 for both");
    checkAges(type, where);
}

void checkImage(const ParticleImage& image, const Where& where) {
    const char* key = where.given("tile") ? "tile" : "tiles";
    const int most = image.columns * image.rows - 1;
    for (const int tile : {image.firstTile, image.lastTile})
        if (tile < 0 || tile > most)
            throw Error(where.locate(key), "the image has tiles 0 to ", most, ", found ", tile);
    if (image.firstTile > image.lastTile)
        throw Error(where.locate(key), "expected [first, last], found ", image.firstTile, " above ",
                    image.lastTile);
    if (image.flipBook && image.firstTile == image.lastTile)
        throw Error(where.locate("flipBook"), "a flip-book needs at least two tiles");
}

void checkPixels(ParticleImage& image, const Where& where) {
    const Image pixels = readPng(image.file);
    if (pixels.width % image.columns != 0 || pixels.height % image.rows != 0)
        throw Error(where.locate("file"), "the image is ", pixels.width, " x ", pixels.height,
                    " pixels, which ", image.columns, " x ", image.rows,
                    " tiles of the same size do not fill");
}

void readFileOf(JsonReader& r, ParticleImage& image, void*) {
    image.file = needFile(r, "file");
}

void readTile(JsonReader& r, ParticleImage& image, void*) {
    image.lastTile = image.columns * image.rows - 1;
    if (r.get("tile", image.firstTile)) image.lastTile = image.firstTile;
}

void readTiles(JsonReader& r, ParticleImage& image, void*) {
    std::vector<int> ends;
    if (!r.get("tiles", ends)) return;
    if (r.has("tile")) throw Error(r.locate("tiles"), "\"tiles\" is given besides \"tile\": one of the two");
    if (ends.size() != 2)
        throw Error(r.locate("tiles"), "expected [first, last], found ", ends.size(), " numbers");
    image.firstTile = ends[0];
    image.lastTile = ends[1];
}

}  // namespace

const char* name(ParticleShape shape) {
    return shapeWords[size_t(shape)].c_str();
}

const char* name(ParticleFacing facing) {
    return facingWords[size_t(facing)].c_str();
}

const Description& describe(const ColorKey*) {
    static const Description description =
        Describe<ColorKey>("keyframe", "Colour and opacity at a moment of a particle's life.")
            .key(
                "age", &ColorKey::age,
                {"",
                 "The share of its life, above that of the keyframe before; only the first may leave it out.",
                 Range::between(0, 1)})
            .color(
                "color", &ColorKey::color,
                {"", "Linear red, green and blue; above 1 it glows.", Range::between(0, mostParticleColor)})
            .key("opacity", &ColorKey::opacity, {"", "How much it covers.", Range::between(0, 1)});
    return description;
}

const Description& describe(const ParticleImage*) {
    using P = ParticleImage;
    static const Description description =
        Describe<P>("image", "An image, cut into tiles of the same size.")
            .byHand("file", {.notEmpty = true}, {"the name of a PNG with alpha", "The image."}, readFileOf)
            .needed()
            .key("columns", &P::columns,
                 {"", "The number of tiles from left to right.", Range::between(1, mostTiles)})
            .key("rows", &P::rows,
                 {"",
                  "The number of tiles from top to bottom; they count along the rows from 0 at the upper "
                  "left.",
                  Range::between(1, mostTiles)})
            .byHand("tile", {.value = Form::Value::whole, .range = Range::atLeast(0)},
                    {"whole number", "The only tile in use."}, readTile)
            .byHand("tiles", {.value = Form::Value::whole, .lists = {{2, 2}}, .range = Range::atLeast(0)},
                    {"[first, last]", "The tiles in use; all without it."}, readTiles)
            .key("flipBook", &P::flipBook,
                 {"",
                  "Whether each particle shows all tiles one after another; else it shows one, by its seed."})
            .key("frameRate", &P::frameRate,
                 {"1/s",
                  "How fast the flip-book goes, over and over; 0: once, over the particle's life.",
                  Range::between(0, mostFrameRate),
                  {0, 60}})
            .only("flipBook", {"true"})
            .key("blend", &P::blend, {"", "Whether neighbouring frames fade into one another."})
            .only("flipBook", {"true"})
            .derive(checkPixels)
            .rule(checkImage, R"({"not": {"required": ["tile", "tiles"]}})");
    return description;
}

const Description& describe(const ParticleType*) {
    using P = ParticleType;
    const Range turns = Range::between(-mostParticleTurn, mostParticleTurn);
    const std::vector<std::string> sized = {"sprites", "quads"};
    constexpr double round = 6.283185307179586;
    static const Description description =
        Describe<P>("particle", "A type of point particle: its mass and its looks.")
            .key("mass", &P::mass,
                 {"kg", "Its mass.", Range::between(leastParticleMass, mostParticleMass), {1e-6, 10, true}})
            .word("shape", &P::shape, shapeWords,
                  {"",
                   "Dots of a fixed number of pixels, squares that face the camera, or squares of any size "
                   "and facing."})
            .key("pixels", &P::pixels,
                 {"pixels", "The diameter of a dot.", Range::between(1, mostParticlePixels)})
            .only("shape", {"points"})
            .span("size", &P::size,
                  {"m",
                   "The diameter, random between the two.",
                   Range::between(leastParticleSize, mostParticleSize),
                   {0.0005, 1, true}})
            .only("shape", sized)
            .ends("growth", &P::growth,
                  {"",
                   "The factors on the size at birth and at the end of life.",
                   Range::between(0, mostParticleSize),
                   {0, 4}})
            .only("shape", sized)
            .word("facing", &P::facing, facingWords,
                  {"",
                   "Whether it turns about the line of sight, points along its velocity, or turns in space."})
            .only("shape", {"quads"})
            .key("stretch", &P::stretch,
                 {"s",
                  "The length grows by this times the speed across the view.",
                  Range::between(0, mostParticleSize),
                  {0, 0.5, true}})
            .only("shape", {"quads"})
            .only("facing", {"velocity"})
            .span("turn", &P::turn,
                  {"rad", "The turn at birth, random between the two.", turns, {-round, round}})
            .only("shape", sized)
            .only("facing", {"camera", "free"})
            .span("spin", &P::spin,
                  {"rad/s", "How fast it turns, random between the two.", turns, {-2 * round, 2 * round}})
            .only("shape", sized)
            .only("facing", {"camera", "free"})
            .key("colors", &P::colors, {"", "Its colours over its life, 1 to 4 keyframes."})
            .usually("white")
            .key("image", &P::image, {"", "What it shows; a round dot with a soft edge without it."})
            .only("shape", sized)
            .word("blend", &P::blend, blendWords(), {"", "How it meets what is drawn behind it."})
            .word("sort", &P::sort, sortWords(),
                  {"", "How particles come into the order from back to front."})
            .only("blend", {"alpha"})
            .key("spreadFrames", &P::spreadFrames,
                 {"",
                  "Over how many frames one sort is spread.",
                  Range::between(1, mostSpreadFrames),
                  {1, 60}})
            .only("blend", {"alpha"})
            .only("sort", {"spread"})
            .key("softness", &P::softness,
                 {"m",
                  "It fades where a surface is nearer than this behind it.",
                  Range::between(0, mostParticleSize),
                  {0, 1, true}})
            .only("blend", {"alpha", "additive", "multiplicative"})
            .key("lit", &P::lit, {"", "Whether sun and sky light it; else it sends its own colour."})
            .only("blend", {"none", "alpha", "additive"})
            .rule(checkType, R"({"properties": {"colors": {"minItems": 1, "maxItems": 4}}})");
    return description;
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

ColorPieces colorPieces(const std::vector<ColorKey>& keys) {
    const auto valueOf = [](const ColorKey& key) { return glm::vec4(key.color, key.opacity); };
    ColorPieces out;
    out.first = valueOf(keys.front());
    for (size_t i = 0; i + 1 < keys.size(); ++i) {
        const auto component = glm::length_t(i);
        out.changes[i] = valueOf(keys[i + 1]) - valueOf(keys[i]);
        out.begins[component] = float(keys[i].age);
        out.perAge[component] = float(1 / (keys[i + 1].age - keys[i].age));
    }
    return out;
}

static constexpr double leastAgeGap = 0.01;

double ageBetween(const std::vector<ColorKey>& keys, size_t key, double age) {
    const double least = key == 0 ? 0 : keys[key - 1].age + leastAgeGap;
    const double most = key + 1 == keys.size() ? 1 : keys[key + 1].age - leastAgeGap;
    return least < most ? std::clamp(age, least, most) : keys[key].age;
}

void addColorKey(std::vector<ColorKey>& keys) {
    if (keys.size() >= mostColorKeys) return;
    if (keys.back().age < 1 - leastAgeGap && keys.size() == 1) {
        ColorKey last = keys.back();
        last.age = 1;
        keys.push_back(last);
        return;
    }
    size_t widest = 0;
    double gap = 0;
    for (size_t i = 0; i + 1 < keys.size(); ++i) {
        const double own = keys[i + 1].age - keys[i].age;
        if (own > gap) gap = own, widest = i;
    }
    if (gap <= 2 * leastAgeGap) return;
    const ColorKey &a = keys[widest], &b = keys[widest + 1];
    keys.insert(keys.begin() + std::ptrdiff_t(widest) + 1,
                {0.5 * (a.age + b.age), 0.5 * (a.color + b.color), 0.5 * (a.opacity + b.opacity)});
}

Molecule moleculeOf(const ParticleType& type) {
    Molecule out;
    out.name = "particle";
    Vertex vertex;
    vertex.mass = type.mass;
    out.vertices.push_back(vertex);
    out.material.color = type.colors.front().color;
    out.material.pointSize = 0.5 * (type.size.x + type.size.y);
    out.material.blend = type.blend;
    out.material.opacity = 1;
    out.material.sort = type.sort;
    out.material.spreadFrames = type.spreadFrames;
    return out;
}

}  // namespace shoal
