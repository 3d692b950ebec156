// Defines molecule files: their keys, their limits, and the rules between them. What is refused here would
// have no meaning or break a solver; what is merely unlikely to be meant is a warning of check().
#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "core/describe.h"
#include "core/file.h"
#include "core/where.h"
#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"

namespace shoal {

namespace {

constexpr size_t mostBytes = size_t{1} << 28;
constexpr double anySize = std::numeric_limits<double>::infinity();  // these limits are a molecule's own
const Range share = Range::between(0, 1), coordinateLimits = Range::between(-maxCoordinate, maxCoordinate);
const Range massLimits = Range::between(1e-12, 1e12);  // kg

// ---- Values of elements that do not give their own

struct Defaults {
    std::optional<double> mass, stiffness, damping;
    bool spelled = false;  // every element says its own

    Defaults() = default;
    Defaults(const Molecule& molecule, bool all) : spelled(all) {
        if (all) return;
        const auto shared = [](const auto& elements, auto number) -> std::optional<double> {
            const auto [value, count] = commonest(elements, number);
            return count > 1 ? std::optional(value) : std::nullopt;
        };
        mass = shared(molecule.vertices, &Vertex::mass);
        stiffness = shared(molecule.springs, &Spring::stiffness);
        damping = shared(molecule.springs, &Spring::damping);
    }
};

const Description& describe(const Defaults*) {
    static const Description description =
        Describe<Defaults>("defaults", "Values of elements that do not give their own.")
            .key("mass", &Defaults::mass, {"kg", "The mass of a vertex.", massLimits})
            .key("stiffness", &Defaults::stiffness, {"N/m", "The stiffness of a spring.", coefficientLimits})
            .key("damping", &Defaults::damping,
                 {"N s/m", "The damping of a spring, else 0.", coefficientLimits});
    return description;
}

// The element's own value, else the default, else an error that names both ways to give it.
void ownOrDefault(JsonReader& r, const char* key, Range range, const std::optional<double>& fallback,
                  double& out) {
    if (r.get(key, out, range)) return;
    if (!fallback) throw Error(r.here(), "missing key \"", key, "\" (give it here or in \"defaults\")");
    out = *fallback;
}

JsonValue unlessDefault(double value, const std::optional<double>& fallback) {
    return value == fallback ? JsonValue() : JsonValue::makeNumber(value);
}

const Defaults& defaultsOf(const void* context) {
    return *static_cast<const Defaults*>(context);
}

void readDefaults(JsonReader& root, Molecule&, Defaults* defaults) {
    auto r = root.object("defaults");
    if (!r) return;
    describe(defaults).read(*r, *defaults);
    r->finish();
}

JsonValue writeDefaults(const Molecule&, const void* context) {
    const Defaults& defaults = defaultsOf(context);
    JsonValue out = describe(&defaults).write(defaults);
    return out.members.empty() ? JsonValue() : out;
}

// ---- Triangles

void readTriangles(JsonReader& root, Molecule& molecule, Defaults*) {
    std::vector<glm::ivec3> triples;
    if (!root.get("triangles", triples)) return;
    needAtMost(root, "triangles", triples.size(), maxMoleculeTriangles);
    const Where whole(root);
    for (size_t t = 0; t < triples.size(); ++t) {
        const glm::ivec3 triple = triples[t];
        const Where here = whole.in("triangles", t);
        for (int i = 0; i < 3; ++i)
            checkIndex(triple[i], molecule, here.element(size_t(i)));
        molecule.triangles.push_back({triple.x, triple.y, triple.z});
        checkCorners(molecule.triangles.back(), here);
        molecule.places.triangles.push_back(here.here());
    }
}

JsonValue writeTriangles(const Molecule& molecule, const void*) {
    JsonValue out = JsonValue::makeArray();
    for (const Triangle& t : molecule.triangles)
        out.items.push_back(JsonValue::makeVector(glm::dvec3(t.a, t.b, t.c)));
    return molecule.triangles.empty() ? JsonValue() : out;
}

// ---- Rules

void checkEnds(const Spring& spring, const Molecule& molecule, const Where& where) {
    checkIndex(spring.a, molecule, where.in("a"));
    checkIndex(spring.b, molecule, where.in("b"));
    if (spring.a == spring.b)
        throw Error(where.locate("b"), "a spring needs two different vertices, found ", spring.a, " twice");
}

// A spring acts along the line between its ends: where that has no direction, in the floats of the state,
// they would stay together for ever, whatever the rest length.
void checkDirection(const Spring& spring, const Molecule& molecule, const Where& where) {
    const glm::dvec3 &a = molecule.vertices[size_t(spring.a)].position,
                     &b = molecule.vertices[size_t(spring.b)].position;
    if (glm::distance(a, b) < leastLength || glm::vec3(a) == glm::vec3(b))
        throw Error(where.here(), "this spring has no direction: vertices ", spring.a, " and ", spring.b,
                    " stand in the same place, from which it could not part them (move one)");
}

// `seen`: the ends of the springs before.
void checkNew(const Spring& spring, std::set<std::pair<int, int>>& seen, const Where& where) {
    if (!seen.insert(std::minmax(spring.a, spring.b)).second)
        throw Error(where.here(), "a spring between vertices ", spring.a, " and ", spring.b,
                    " exists already: add up their stiffness instead");
}

void checkParts(const Molecule& molecule, const Where& where) {
    if (molecule.vertices.empty())
        throw Error(where.locate("vertices"), "expected at least one vertex, found none");
    needAtMost(where, "vertices", molecule.vertices.size(), maxMoleculeVertices);
    needAtMost(where, "springs", molecule.springs.size(), maxMoleculeSprings);
    needAtMost(where, "bends", molecule.bends.size(), maxMoleculeSprings);
    needAtMost(where, "triangles", molecule.triangles.size(), maxMoleculeTriangles);
    std::set<std::pair<int, int>> seen;
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Where here = where.in("springs", i);
        checkEnds(molecule.springs[i], molecule, here);
        checkDirection(molecule.springs[i], molecule, here);
        checkNew(molecule.springs[i], seen, here);
    }
    checkBends(molecule, where);
    for (size_t i = 0; i < molecule.triangles.size(); ++i) {
        const Triangle& t = molecule.triangles[i];
        for (const int corner : {t.a, t.b, t.c})
            checkIndex(corner, molecule, where.in("triangles", i));
        checkCorners(t, where.in("triangles", i));
    }
    checkSkin(molecule, where.in("skin"));
    if (molecule.material.texture.find('\0') != std::string::npos)
        throw Error(where.in("material").locate("texture"), "expected a file name, found a zero byte in it");
}

// Where each element stands in the file.
void findPlaces(Molecule& molecule, const Where& where) {
    for (size_t i = 0; i < molecule.vertices.size(); ++i)
        molecule.places.vertices.push_back(where.in("vertices", i).here());
    for (size_t i = 0; i < molecule.springs.size(); ++i)
        molecule.places.springs.push_back(where.in("springs", i).here());
    for (size_t i = 0; i < molecule.bends.size(); ++i)
        molecule.places.bends.push_back(where.in("bends", i).here());
}

}  // namespace

// ---- Keys

const Description& describe(const Vertex*) {
    static const auto readMass = [](JsonReader& r, Vertex& vertex, Defaults& defaults) {
        ownOrDefault(r, "mass", massLimits, defaults.mass, vertex.mass);
    };
    static const auto writeMass = [](const Vertex& vertex, const void* context) {
        return unlessDefault(vertex.mass, defaultsOf(context).mass);
    };
    static const Description description =
        Describe<Vertex>("vertex", "A point with a mass.")
            .key("position", &Vertex::position,
                 {"m",
                  "Where it is in the rest shape; placement turns and scales it about [0, 0, 0], with +Y "
                  "along the axis of the place.",
                  coordinateLimits})
            .needed()
            .key("uv", &Vertex::uv,
                 {"", "Its texture coordinates, [0, 0] at the lower left.", coordinateLimits})
            .key("mass", &Vertex::mass, {"kg", "Its mass.", massLimits})
            .usually("from `defaults`")
            .reads<Defaults>(readMass)
            .writes(writeMass)
            .key("pinned", &Vertex::pinned,
                 {"", "Whether it is held where it was placed, until the scene releases it."});
    return description;
}

const Description& describe(const Actuation*) {
    using A = Actuation;
    static const Description description =
        Describe<A>("actuation", "A muscle: L(t) = L (1 + amplitude sin(2π frequency t + phase)).")
            .key("amplitude", &A::amplitude,
                 {"", "The share of the rest length by which it swings.", Range::between(0, 0.99)})
            .needed()
            .key("frequency", &A::frequency, {"Hz", "How often it swings.", Range::between(0, mostFrequency)})
            .needed()
            .key("phase", &A::phase,
                 {"rad", "Where in the swing it begins; a group's `phaseSpread` adds to it.",
                  coordinateLimits});
    return description;
}

const Description& describe(const Spring*) {
    static const auto readStiffness = [](JsonReader& r, Spring& spring, Defaults& defaults) {
        ownOrDefault(r, "stiffness", coefficientLimits, defaults.stiffness, spring.stiffness);
    };
    static const auto readDamping = [](JsonReader& r, Spring& spring, Defaults& defaults) {
        ownOrDefault(r, "damping", coefficientLimits, defaults.damping.value_or(0), spring.damping);
    };
    static const auto writeStiffness = [](const Spring& spring, const void* context) {
        return unlessDefault(spring.stiffness, defaultsOf(context).stiffness);
    };
    static const auto writeDamping = [](const Spring& spring, const void* context) {
        const Defaults& defaults = defaultsOf(context);
        if (defaults.spelled) return JsonValue::makeNumber(spring.damping);
        return unlessDefault(spring.damping, defaults.damping.value_or(0));
    };
    static const Description description =
        Describe<Spring>("spring", "A spring between two vertices, one a pair.")
            .key("a", &Spring::a, {"", "The index of the vertex at one end."})
            .needed()
            .key("b", &Spring::b, {"", "The index of the vertex at the other end."})
            .needed()
            .key("stiffness", &Spring::stiffness, {"N/m", "Its stiffness.", coefficientLimits})
            .usually("from `defaults`")
            .reads<Defaults>(readStiffness)
            .writes(writeStiffness)
            .key("damping", &Spring::damping, {"N s/m", "Its damping, along the spring.", coefficientLimits})
            .usually("from `defaults`, else 0")
            .reads<Defaults>(readDamping)
            .writes(writeDamping)
            .key("restLength", &Spring::restLength,
                 {"m",
                  "Its rest length; another one than in the rest shape makes the molecule start under "
                  "tension.",
                  Range::between(leastLength, maxCoordinate)})
            .usually("the distance in the rest shape")
            .key("actuation", &Spring::actuation, {"", "A muscle: its rest length swings."})
            .rule([](const Spring&, const Where&) {},
                  R"({"properties": {"a": {"minimum": 0}, "b": {"minimum": 0}}})");
    return description;
}

const Description& describe(const Material*) {
    using M = Material;
    static const auto writeColor = [](const M& material, const void*) {
        return JsonValue::makeVector(material.color);
    };
    static const Description description =
        Describe<M>("material", "How a molecule looks.")
            .color("color", &M::color, {"", "Its colour, which multiplies the texture.", share})
            .writes(writeColor)
            .color(
                "secondColor", &M::secondColor,
                {"", "Instances vary between the colour and this one at random, most near the first.", share})
            .key("texture", &M::texture,
                 {"the name of a PNG",
                  "The texture, from the molecule file's folder; its alpha cuts the shape out."})
            .key("alphaCut", &M::alphaCut,
                 {"", "Where the texture's alpha is lower, nothing is drawn.", share})
            .key("translucency", &M::translucency,
                 {"", "The share of the light that shines through from behind.", share})
            .key("roughness", &M::roughness, {"", "How dull it is.", share})
            .key(
                "metallic", &M::metallic,
                {"", "The share of a mirror, tinted by the colour: silver where the colour is light.", share})
            .key("pointSize", &M::pointSize,
                 {"m", "The diameter of the dots of a molecule without triangles.",
                  Range{0, maxCoordinate, true}})
            .word("blend", &M::blend, blendWords(),
                  {"",
                   "How it is laid over what lies behind: with its opacity, added to it, or as a filter of "
                   "its colour."})
            .key("opacity", &M::opacity, {"", "How much it covers.", share})
            .only("blend", {"alpha", "additive", "multiplicative"})
            .word("sort", &M::sort, sortWords(),
                  {"",
                   "Whether molecules are drawn as they are numbered, sorted from back to front in every "
                   "frame, or sorted a little in every frame."})
            .only("blend", {"alpha"})
            .key("spreadFrames", &M::spreadFrames,
                 {"", "Over how many frames one sort is spread.", Range::between(1, mostSpreadFrames)})
            .only("blend", {"alpha"})
            .only("sort", {"spread"});
    return description;
}

const Description& describe(const Molecule*) {
    using M = Molecule;
    static const auto readSkinOf = [](JsonReader& r, M& molecule, void*) { readSkin(r, molecule); };
    static const auto writeSkinOf = [](const M& molecule, const void*) {
        return molecule.skin.vertices.empty() ? JsonValue() : describeSkin().write(molecule.skin);
    };
    static const Form triples = {.value = Form::Value::whole,
                                 .lists = {{.most = maxMoleculeTriangles}, {3, 3}},
                                 .range = Range::atLeast(0)};
    static const Description description =
        Describe<M>("molecule", "A small mass-spring mesh that every instance of a group shares.")
            .format("shoal-molecule-1")
            .key("name", &M::name, {"", "Its name, and that of groups that have none."})
            .byHand<Defaults>("defaults", {.value = Form::Value::keys},
                              {"object", "Values of elements that do not give their own."}, readDefaults,
                              writeDefaults)
            .holdsKeys(describeDefaults())
            .key("vertices", &M::vertices, {"", "Its vertices, 1 to 65,536."})
            .needed()
            .key("springs", &M::springs, {"", "Its springs, at most 1,048,576."})
            .key("bends", &M::bends, {"", "Its bends, at most 1,048,576."})
            .byHand<Defaults>("triangles", triples,
                              {"list of [a, b, c]",
                               "Three different vertices each, anticlockwise seen from the front, at most "
                               "1,048,576. They are drawn, and give normals and directional drag."},
                              readTriangles, writeTriangles)
            .byHand("skin", {.value = Form::Value::keys}, {"object", describeSkin().sentence()}, readSkinOf,
                    writeSkinOf)
            .holdsKeys(describeSkin())
            .key("material", &M::material, {"", "How it looks."})
            .derive(findPlaces)
            .rule(checkParts, R"({"properties": {"vertices": {"minItems": 1, "maxItems": 65536},
                                                 "springs": {"maxItems": 1048576},
                                                 "bends": {"maxItems": 1048576}}})");
    return description;
}

const Description& describeDefaults() {
    return describe(static_cast<const Defaults*>(nullptr));
}

// ---- What others check by the same rules

void checkIndex(int index, const Molecule& molecule, const Where& where) {
    const size_t count = molecule.vertices.size();
    if (index < 0 || size_t(index) >= count)
        throw Error(where.here(), "vertex index ", index, " is out of range: the molecule has ", count,
                    count == 1 ? " vertex" : " vertices");
}

void checkCorners(const Triangle& t, const Where& where) {
    if (t.a == t.b || t.b == t.c || t.c == t.a)
        throw Error(where.here(), "a triangle needs three different vertices, found ", t.a, ", ", t.b, ", ",
                    t.c);
}

void checkMolecule(const Molecule& molecule, const Where& where) {
    describe(&molecule).check(molecule, where, anySize);
}

// ---- Files

Molecule parseMolecule(const std::string& text, const std::string& file) {
    const JsonValue root = parseJson(text, file);
    Molecule molecule;
    molecule.file = file;
    Defaults defaults;
    describe(&molecule).readFile(root, file, molecule, &defaults);
    if (const JsonValue* comment = root.find("comment")) molecule.comment = comment->text;
    return molecule;
}

Image readTexture(const Molecule& molecule) {
    const std::filesystem::path file =
        std::filesystem::path(molecule.file).parent_path() / molecule.material.texture;
    try {
        return readPng(file);
    } catch (const Error& error) {
        throw Error(Location{.file = molecule.file, .path = "$.material.texture"}, "the texture \"",
                    file.string(), "\": ", error.message());
    }
}

Molecule readMolecule(const std::string& file) {
    return parseMolecule(readFile(file, mostBytes), file);
}

JsonValue toJson(const Molecule& molecule, bool spelled) {
    const Defaults defaults(molecule, spelled);
    JsonValue out = JsonValue::makeObject();
    out.add("format", JsonValue::makeString("shoal-molecule-1"));
    for (JsonMember& member : describe(&molecule).write(molecule, &defaults).members) {
        const bool named = member.first == "name";
        if (!named && !molecule.comment.empty() && !out.find("comment"))
            out.add("comment", JsonValue::makeString(molecule.comment));
        out.members.push_back(std::move(member));
    }
    return out;
}

std::string writeMolecule(const Molecule& molecule) {
    return writeJson(toJson(molecule, false));
}

}  // namespace shoal
