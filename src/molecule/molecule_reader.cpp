// From a molecule file to a Molecule. What is refused here would have no meaning or break a solver; what is
// merely unlikely to be meant is a warning of check().
#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "core/file.h"
#include "core/file_format.h"
#include "core/json.h"
#include "molecule/molecule_file.h"
#include "molecule/rules.h"
#include "molecule/skin_file.h"

namespace shoal {

namespace {

constexpr size_t mostBytes = size_t{1} << 28;

struct Defaults {
    std::optional<double> mass, stiffness, damping;
};

double readMass(JsonReader& reader, const std::string& key) {
    double mass = 0;
    reader.need(key, mass);
    checkMass(mass, reader.at(key));
    return mass;
}

double readCoefficient(JsonReader& reader, const std::string& key) {
    double value = 0;
    reader.need(key, value);
    checkCoefficient(value, reader.at(key));
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

void readVertices(JsonReader& root, const Defaults& defaults, Molecule& molecule) {
    root.require("vertices");
    std::vector<JsonReader> readers = root.objects("vertices");
    if (readers.empty()) throw Error(root.at("vertices"), "expected at least one vertex, found none");
    needAtMost(root, "vertices", readers.size(), maxMoleculeVertices);
    for (JsonReader& reader : readers) {
        Vertex vertex;
        reader.require("position");
        members(ReadMembers(reader), vertex);
        vertex.mass = ownOrDefault(reader, "mass", defaults.mass, readMass);
        reader.get("pinned", vertex.pinned);
        reader.finish();
        molecule.vertices.push_back(vertex);
        molecule.places.vertices.push_back(reader.here());
    }
}

std::optional<Actuation> readActuation(JsonReader& spring) {
    auto reader = spring.object("actuation");
    if (!reader) return std::nullopt;
    Actuation actuation;
    reader->require("amplitude");
    reader->require("frequency");
    members(ReadMembers(*reader), actuation);
    reader->finish();
    return actuation;
}

Spring readSpring(JsonReader& reader, const Defaults& defaults, const Molecule& molecule) {
    Spring spring;
    reader.need("a", spring.a);
    reader.need("b", spring.b);
    checkEnds(spring, molecule, reader);
    spring.stiffness = ownOrDefault(reader, "stiffness", defaults.stiffness, readCoefficient);
    spring.damping = ownOrDefault(reader, "damping", defaults.damping.value_or(0), readCoefficient);
    double length = 0;
    if (reader.get("restLength", length)) spring.restLength = length;
    spring.actuation = readActuation(reader);
    reader.finish();
    checkLength(spring, molecule, reader);
    return spring;
}

void readSprings(JsonReader& root, const Defaults& defaults, Molecule& molecule) {
    std::vector<JsonReader> readers = root.objects("springs");
    needAtMost(root, "springs", readers.size(), maxMoleculeSprings);
    std::set<std::pair<int, int>> seen;
    for (JsonReader& reader : readers) {
        const Spring spring = readSpring(reader, defaults, molecule);
        checkNew(spring, seen, reader);
        molecule.springs.push_back(spring);
        molecule.places.springs.push_back(reader.here());
    }
}

void readTriangles(JsonReader& root, Molecule& molecule) {
    std::vector<glm::ivec3> triples;
    if (!root.get("triangles", triples)) return;
    needAtMost(root, "triangles", triples.size(), maxMoleculeTriangles);
    const JsonValue& array = *root.raw("triangles");
    for (size_t t = 0; t < triples.size(); ++t) {
        const glm::ivec3 triple = triples[t];
        const JsonValue& item = array.items[t];
        const std::string path = concat(root.path(), ".triangles[", t, "]");
        for (int i = 0; i < 3; ++i) {
            const JsonValue& corner = item.items[size_t(i)];
            checkIndex(triple[i], molecule,
                       {root.file(), corner.line, corner.column, concat(path, "[", i, "]")});
        }
        const Location here{root.file(), item.line, item.column, path};
        const Triangle triangle{triple.x, triple.y, triple.z};
        checkCorners(triangle, here);
        molecule.triangles.push_back(triangle);
        molecule.places.triangles.push_back(here);
    }
}

// Keys that mean nothing beside the others.
void checkBlend(const JsonReader& reader, const Material& material) {
    if (reader.has("opacity") && material.blend == Blend::none)
        throw Error(reader.at("opacity"), "opacity needs a blend: alpha, additive or multiplicative");
    if (reader.has("sort") && material.blend != Blend::alpha)
        throw Error(reader.at("sort"), "only what has the blend alpha needs an order: leave out sort");
    if (reader.has("spreadFrames") && material.sort != DrawSort::spread)
        throw Error(reader.at("spreadFrames"), "spreadFrames is of the sort spread");
}

void readMaterial(JsonReader& root, Material& material) {
    auto reader = root.object("material");
    if (!reader) return;
    reader->get("texture", material.texture);
    checkTexture(material, *reader);
    members(ReadMembers(*reader), material);
    checkBlend(*reader, material);
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

Image readTexture(const Molecule& molecule) {
    const std::filesystem::path file =
        std::filesystem::path(molecule.file).parent_path() / molecule.material.texture;
    try {
        return readPng(file);
    } catch (const Error& error) {
        throw Error(Location{molecule.file, 0, 0, "$.material.texture"},
                    concat("the texture \"", file.string(), "\": ", error.message()));
    }
}

Molecule readMolecule(const std::string& file) {
    return parseMolecule(readFile(file, mostBytes), file);
}

}  // namespace shoal
