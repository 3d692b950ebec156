// From a molecule file to a Molecule. What is refused here would have no meaning or break a solver; what is
// merely unlikely to be meant is a warning of check().
#include <algorithm>
#include <set>
#include <utility>

#include "core/file.h"
#include "core/file_format.h"
#include "core/json.h"
#include "molecule/molecule_file.h"
#include "molecule/skin_file.h"

namespace shoal {

namespace {

// Sizes that single precision on the GPU can square and add without overflow.
constexpr double maxCoordinate = 1e6;                 // m
constexpr double leastMass = 1e-12, mostMass = 1e12;  // kg
constexpr double mostStiffness = 1e15;                // N/m, and N s/m
constexpr double mostFrequency = 1e6;                 // Hz
constexpr double leastLength = 1e-9;                  // m, below which two vertices stand in one place
constexpr size_t mostBytes = size_t{1} << 28;

struct Defaults {
    std::optional<double> mass, stiffness, damping;
};

double readMass(JsonReader& reader, const std::string& key) {
    double mass = 0;
    reader.need(key, mass, Range::positive());
    if (mass < leastMass || mass > mostMass)
        throw Error(reader.at(key),
                    concat("expected a mass from ", leastMass, " to ", mostMass, " kg, found ", mass));
    return mass;
}

double readCoefficient(JsonReader& reader, const std::string& key) {
    double value = 0;
    reader.need(key, value, Range::atLeast(0));
    if (value > mostStiffness)
        throw Error(reader.at(key),
                    concat("expected a number of at most ", mostStiffness, ", found ", value));
    return value;
}

Defaults readDefaults(JsonReader& root) {
    Defaults defaults;
    if (auto reader = root.object("defaults")) {
        if (reader->has("mass")) defaults.mass = readMass(*reader, "mass");
        if (reader->has("stiffness")) defaults.stiffness = readCoefficient(*reader, "stiffness");
        if (reader->has("damping")) defaults.damping = readCoefficient(*reader, "damping");
        for (const char* key : {"mass", "stiffness", "damping"})
            reader->raw(key);  // known even when absent
        reader->finish();
    }
    return defaults;
}

// The element's own value, else the default, else an error that names both ways to give it.
double ownOrDefault(JsonReader& reader, const std::string& key, const std::optional<double>& fallback,
                    double (*read)(JsonReader&, const std::string&)) {
    reader.raw(key);
    if (reader.has(key)) return read(reader, key);
    if (fallback) return *fallback;
    throw Error(reader.here(), "missing key \"" + key + "\" (give it here or in \"defaults\")");
}

void checkCount(const JsonReader& root, const std::string& key, size_t count, int most) {
    if (count > size_t(most))
        throw Error(root.at(key), concat("expected at most ", most, " ", key, ", found ", count));
}

void readVertices(JsonReader& root, const Defaults& defaults, Molecule& molecule) {
    root.require("vertices");
    std::vector<JsonReader> readers = root.objects("vertices");
    if (readers.empty()) throw Error(root.at("vertices"), "expected at least one vertex, found none");
    checkCount(root, "vertices", readers.size(), maxMoleculeVertices);
    for (JsonReader& reader : readers) {
        Vertex vertex;
        reader.need("position", vertex.position, Range::between(-maxCoordinate, maxCoordinate));
        reader.get("uv", vertex.uv, Range::between(-maxCoordinate, maxCoordinate));
        vertex.mass = ownOrDefault(reader, "mass", defaults.mass, readMass);
        reader.get("pinned", vertex.pinned);
        reader.finish();
        molecule.vertices.push_back(vertex);
        molecule.places.vertices.push_back(reader.here());
    }
}

void checkIndex(const Location& where, int index, const Molecule& molecule) {
    const size_t count = molecule.vertices.size();
    if (index < 0 || size_t(index) >= count)
        throw Error(where, concat("vertex index ", index, " is out of range: the molecule has ", count,
                                  count == 1 ? " vertex" : " vertices"));
}

int readIndex(JsonReader& reader, const std::string& key, const Molecule& molecule) {
    int index = 0;
    reader.need(key, index);
    checkIndex(reader.at(key), index, molecule);
    return index;
}

std::optional<Actuation> readActuation(JsonReader& spring) {
    auto reader = spring.object("actuation");
    if (!reader) return std::nullopt;
    Actuation actuation;
    reader->need("amplitude", actuation.amplitude, Range::between(0, 0.99));
    reader->need("frequency", actuation.frequency, Range::between(0, mostFrequency));
    reader->get("phase", actuation.phase, Range::between(-maxCoordinate, maxCoordinate));
    reader->finish();
    return actuation;
}

Spring readSpring(JsonReader& reader, const Defaults& defaults, const Molecule& molecule) {
    Spring spring;
    spring.a = readIndex(reader, "a", molecule);
    spring.b = readIndex(reader, "b", molecule);
    if (spring.a == spring.b)
        throw Error(reader.at("b"),
                    concat("a spring needs two different vertices, found ", spring.a, " twice"));
    spring.stiffness = ownOrDefault(reader, "stiffness", defaults.stiffness, readCoefficient);
    spring.damping = ownOrDefault(reader, "damping", defaults.damping.value_or(0), readCoefficient);
    double length = 0;
    if (reader.get("restLength", length, Range::positive())) {
        if (length < leastLength || length > maxCoordinate)
            throw Error(reader.at("restLength"), concat("expected a length from ", leastLength, " to ",
                                                        maxCoordinate, " m, found ", length));
        spring.restLength = length;
    }
    spring.actuation = readActuation(reader);
    reader.finish();
    if (molecule.restLength(spring) < leastLength)
        throw Error(reader.here(), concat("this spring has no length: vertices ", spring.a, " and ", spring.b,
                                          " stand in the same place (move one, or give a restLength)"));
    return spring;
}

void readSprings(JsonReader& root, const Defaults& defaults, Molecule& molecule) {
    std::vector<JsonReader> readers = root.objects("springs");
    checkCount(root, "springs", readers.size(), maxMoleculeSprings);
    std::set<std::pair<int, int>> seen;
    for (JsonReader& reader : readers) {
        const Spring spring = readSpring(reader, defaults, molecule);
        if (!seen.insert(std::minmax(spring.a, spring.b)).second)
            throw Error(reader.here(), concat("a spring between vertices ", spring.a, " and ", spring.b,
                                              " exists already: add up their stiffness instead"));
        molecule.springs.push_back(spring);
        molecule.places.springs.push_back(reader.here());
    }
}

void readTriangles(JsonReader& root, Molecule& molecule) {
    std::vector<glm::ivec3> triples;
    if (!root.get("triangles", triples)) return;
    checkCount(root, "triangles", triples.size(), maxMoleculeTriangles);
    const JsonValue& array = *root.raw("triangles");
    for (size_t t = 0; t < triples.size(); ++t) {
        const glm::ivec3 triple = triples[t];
        const JsonValue& item = array.items[t];
        const std::string path = concat(root.path(), ".triangles[", t, "]");
        for (int i = 0; i < 3; ++i) {
            const JsonValue& corner = item.items[size_t(i)];
            checkIndex({root.file(), corner.line, corner.column, concat(path, "[", i, "]")}, triple[i],
                       molecule);
        }
        const Location here{root.file(), item.line, item.column, path};
        if (triple.x == triple.y || triple.y == triple.z || triple.z == triple.x)
            throw Error(here, concat("a triangle needs three different vertices, found ", triple.x, ", ",
                                     triple.y, ", ", triple.z));
        molecule.triangles.push_back({triple.x, triple.y, triple.z});
        molecule.places.triangles.push_back(here);
    }
}

void readBlend(JsonReader& reader, Material& material) {
    int blend = 0, sort = int(material.sort);
    reader.choose("blend", {"none", "alpha", "additive", "multiplicative"}, blend);
    material.blend = Blend(blend);
    if (reader.get("opacity", material.opacity, Range::between(0, 1)) && material.blend == Blend::none)
        throw Error(reader.at("opacity"), "opacity needs a blend: alpha, additive or multiplicative");
    if (reader.choose("sort", {"none", "frame", "spread"}, sort) && material.blend != Blend::alpha)
        throw Error(reader.at("sort"), "only what has the blend alpha needs an order: leave out sort");
    material.sort = DrawSort(sort);
    if (reader.get("spreadFrames", material.spreadFrames, Range::between(1, mostSpreadFrames)) &&
        material.sort != DrawSort::spread)
        throw Error(reader.at("spreadFrames"), "spreadFrames is of the sort spread");
}

void readMaterial(JsonReader& root, Material& material) {
    auto reader = root.object("material");
    if (!reader) return;
    const Range unit = Range::between(0, 1);
    reader->get("color", material.color, unit);
    glm::dvec3 second;
    if (reader->get("secondColor", second, unit)) material.secondColor = second;
    reader->get("texture", material.texture);
    if (material.texture.find('\0') != std::string::npos)
        throw Error(reader->at("texture"), "expected a file name, found a zero byte in it");
    reader->get("alphaCut", material.alphaCut, unit);
    reader->get("translucency", material.translucency, unit);
    reader->get("roughness", material.roughness, unit);
    reader->get("metallic", material.metallic, unit);
    reader->get("pointSize", material.pointSize, Range{0, maxCoordinate, true});
    readBlend(*reader, material);
    reader->finish();
}

}  // namespace

Molecule parseMolecule(const std::string& text, const std::string& file) {
    const JsonValue value = parseJson(text, file);
    JsonReader root(value, file);
    needFormat(root, "shoal-molecule-1");
    Molecule molecule;
    molecule.file = file;
    root.get("name", molecule.name);
    root.get("comment", molecule.comment);
    const Defaults defaults = readDefaults(root);
    readVertices(root, defaults, molecule);
    readSprings(root, defaults, molecule);
    readTriangles(root, molecule);
    readSkin(root, molecule);
    readMaterial(root, molecule.material);
    root.finish();
    return molecule;
}

Molecule readMolecule(const std::string& file) {
    return parseMolecule(readFile(file, mostBytes), file);
}

}  // namespace shoal
