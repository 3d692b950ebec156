#include <algorithm>
#include <cmath>

#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"
#include "molecule/skin.h"

namespace shoal {

const char* const skinSchema = R"({"type": "object", "additionalProperties": false,
    "required": ["weights", "triangles"], "properties": {
        "comment": {"$ref": "#/$defs/comment"},
        "weights": {"description": "For each vertex of the skin: a vertex of the molecule and its weight, up to 8 times; the weights add up to 1.",
            "type": "array", "maxItems": 262144,
            "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 16}},
        "uvs": {"description": "Texture coordinates, as many; all (0, 0) when absent.",
            "type": "array", "maxItems": 262144,
            "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}},
        "offsets": {"description": "How far each stands off along the molecule's normal, as many; all 0 when absent. [m]",
            "type": "array", "maxItems": 262144, "items": {"type": "number"}},
        "triangles": {"description": "Three vertices of the skin each, anticlockwise seen from the front.",
            "type": "array", "minItems": 1, "maxItems": 524288,
            "items": {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 3, "maxItems": 3}}}})";

namespace {

constexpr double mostValue = 1e6;  // of weights, uvs and offsets
constexpr double mostSumError = 1e-5;

bool isIndex(double number, size_t count) {
    return number >= 0 && number < double(count) && number == std::floor(number);
}

Error notIndex(const Location& where, double found, size_t count, const char* of) {
    return Error(where, concat("expected the index of a vertex of ", of, ", 0 to ", int64_t(count) - 1,
                               ", found ", found));
}

// Checks the count of a file's numbers for a skin vertex: pairs of a vertex and its weight.
void checkWeightCount(size_t numbers, const Location& where) {
    if (numbers == 0 || numbers % 2 != 0 || numbers > 2 * Skin::mostWeights)
        throw Error(where, concat("expected 1 to ", Skin::mostWeights,
                                  " pairs of a vertex and its weight, found ", numbers, " numbers"));
}

void checkWeights(const SkinVertex& vertex, const Location& where) {
    double sum = 0;
    for (size_t k = 0; k < vertex.weights.size(); ++k) {
        for (size_t other = 0; other < k; ++other)
            if (vertex.weights[other].vertex == vertex.weights[k].vertex)
                throw Error(where,
                            concat("vertex ", vertex.weights[k].vertex, " has two weights: add them up"));
        sum += vertex.weights[k].weight;
    }
    if (!(std::abs(sum - 1) <= mostSumError))
        throw Error(where, concat("expected weights that add up to 1, found ", sum));
}

void checkNumber(double number, const Location& where) {
    if (!(std::abs(number) <= mostValue))
        throw Error(where,
                    concat("expected a number from ", -mostValue, " to ", mostValue, ", found ", number));
}

void checkOffset(const SkinVertex& vertex, const Molecule& molecule, const Location& where) {
    if (vertex.offset != 0 && molecule.triangles.empty())
        throw Error(where, "an offset is along the normal of the molecule, which has no triangles");
}

// An array in the skin, whose elements are located as they are read.
class Elements {
  public:
    Elements(JsonReader& skin, const std::string& key, int most)
        : array_(skin.raw(key)), file_(skin.file()), path_(skin.path() + "." + key) {
        if (!array_) return;
        kind(*array_, path_, JsonValue::Kind::array, "an array");
        if (array_->items.size() > size_t(most))
            throw Error(at(*array_, path_),
                        concat("expected at most ", most, " ", key, ", found ", array_->items.size()));
    }

    explicit operator bool() const { return array_ != nullptr; }
    size_t count() const { return array_->items.size(); }
    const JsonValue& operator[](size_t i) const { return array_->items[i]; }
    std::string path(size_t i) const { return concat(path_, "[", i, "]"); }
    Location whole() const { return at(*array_, path_); }
    Location at(const JsonValue& value, const std::string& path) const {
        return {file_, value.line, value.column, path};
    }

    // The numbers of element i, each with its place.
    const std::vector<JsonValue>& numbers(size_t i) const {
        const JsonValue& item = (*this)[i];
        kind(item, path(i), JsonValue::Kind::array, "an array of numbers");
        for (size_t k = 0; k < item.items.size(); ++k)
            kind(item.items[k], concat(path(i), "[", k, "]"), JsonValue::Kind::number, "a number");
        return item.items;
    }
    double number(const JsonValue& value, const std::string& path) const {
        kind(value, path, JsonValue::Kind::number, "a number");
        checkNumber(value.number, at(value, path));
        return value.number;
    }
    int index(const JsonValue& value, const std::string& path, size_t count, const char* of) const {
        if (!isIndex(value.number, count)) throw notIndex(at(value, path), value.number, count, of);
        return int(value.number);
    }

  private:
    void kind(const JsonValue& value, const std::string& path, JsonValue::Kind wanted,
              const char* what) const {
        if (value.kind != wanted)
            throw Error(at(value, path), concat("expected ", what, ", found ", name(value.kind)));
    }

    const JsonValue* array_;
    std::string file_, path_;
};

void readWeights(const Elements& weights, const Molecule& molecule, Skin& skin) {
    for (size_t i = 0; i < weights.count(); ++i) {
        const std::vector<JsonValue>& numbers = weights.numbers(i);
        const Location here = weights.at(weights[i], weights.path(i));
        checkWeightCount(numbers.size(), here);
        SkinVertex vertex;
        for (size_t k = 0; k < numbers.size(); k += 2) {
            SkinWeight weight;
            weight.vertex = weights.index(numbers[k], concat(weights.path(i), "[", k, "]"),
                                          molecule.vertices.size(), "the molecule");
            weight.weight = weights.number(numbers[k + 1], concat(weights.path(i), "[", k + 1, "]"));
            vertex.weights.push_back(weight);
        }
        checkWeights(vertex, here);
        skin.vertices.push_back(std::move(vertex));
    }
}

void checkCount(const Elements& elements, size_t count) {
    if (elements.count() != count)
        throw Error(elements.whole(), concat("expected one for each of the skin's ", count,
                                             " weights, found ", elements.count()));
}

void readUvs(const Elements& uvs, Skin& skin) {
    checkCount(uvs, skin.vertices.size());
    for (size_t i = 0; i < uvs.count(); ++i) {
        const std::vector<JsonValue>& pair = uvs.numbers(i);
        if (pair.size() != 2)
            throw Error(uvs.at(uvs[i], uvs.path(i)),
                        concat("expected an array of 2 numbers, found ", pair.size()));
        skin.vertices[i].uv = {uvs.number(pair[0], uvs.path(i)), uvs.number(pair[1], uvs.path(i))};
    }
}

void readOffsets(const Elements& offsets, const Molecule& molecule, Skin& skin) {
    checkCount(offsets, skin.vertices.size());
    for (size_t i = 0; i < offsets.count(); ++i) {
        skin.vertices[i].offset = offsets.number(offsets[i], offsets.path(i));
        checkOffset(skin.vertices[i], molecule, offsets.at(offsets[i], offsets.path(i)));
    }
}

void readSkinTriangles(const Elements& triangles, Skin& skin) {
    for (size_t i = 0; i < triangles.count(); ++i) {
        const std::vector<JsonValue>& corners = triangles.numbers(i);
        const Location here = triangles.at(triangles[i], triangles.path(i));
        if (corners.size() != 3)
            throw Error(here, concat("expected an array of 3 numbers, found ", corners.size()));
        int index[3];
        for (size_t k = 0; k < 3; ++k)
            index[k] = triangles.index(corners[k], concat(triangles.path(i), "[", k, "]"),
                                       skin.vertices.size(), "the skin");
        checkCorners({index[0], index[1], index[2]}, here);
        skin.triangles.push_back({index[0], index[1], index[2]});
    }
}

}  // namespace

void readSkin(JsonReader& root, Molecule& molecule) {
    auto reader = root.object("skin");
    if (!reader) return;
    reader->require("weights");
    reader->require("triangles");
    const Elements weights(*reader, "weights", maxSkinVertices), uvs(*reader, "uvs", maxSkinVertices),
        offsets(*reader, "offsets", maxSkinVertices), triangles(*reader, "triangles", maxSkinTriangles);
    Skin skin;
    readWeights(weights, molecule, skin);
    if (uvs) readUvs(uvs, skin);
    if (offsets) readOffsets(offsets, molecule, skin);
    readSkinTriangles(triangles, skin);
    if (skin.triangles.empty()) throw Error(triangles.whole(), "expected at least one triangle, found none");
    reader->finish();
    molecule.skin = std::move(skin);
    placeSkin(molecule);
}

// Puts a place together only when something is wrong.
template <typename Check>
static void checkAt(const Where& where, const char* key, size_t index, const Check& check) {
    try {
        check(Location{});
    } catch (const Error& error) {
        throw Error(where.in(key, index).here(), error.message());
    }
}

void checkSkin(const Molecule& molecule, const Where& where) {
    const Skin& skin = molecule.skin;
    needAtMost(where, "weights", skin.vertices.size(), maxSkinVertices);
    needAtMost(where, "triangles", skin.triangles.size(), maxSkinTriangles);
    for (size_t i = 0; i < skin.vertices.size(); ++i) {
        const SkinVertex& vertex = skin.vertices[i];
        checkAt(where, "weights", i, [&](const Location& here) {
            checkWeightCount(2 * vertex.weights.size(), here);
            for (const SkinWeight& weight : vertex.weights) {
                if (!isIndex(weight.vertex, molecule.vertices.size()))
                    throw notIndex(here, weight.vertex, molecule.vertices.size(), "the molecule");
                checkNumber(weight.weight, here);
            }
            checkWeights(vertex, here);
        });
        checkAt(where, "uvs", i, [&](const Location& here) {
            checkNumber(vertex.uv.x, here);
            checkNumber(vertex.uv.y, here);
        });
        checkAt(where, "offsets", i, [&](const Location& here) {
            checkNumber(vertex.offset, here);
            checkOffset(vertex, molecule, here);
        });
    }
    for (size_t i = 0; i < skin.triangles.size(); ++i) {
        const SkinTriangle& t = skin.triangles[i];
        checkAt(where, "triangles", i, [&](const Location& here) {
            for (const int corner : {t.a, t.b, t.c})
                if (!isIndex(corner, skin.vertices.size()))
                    throw notIndex(here, corner, skin.vertices.size(), "the skin");
            checkCorners({t.a, t.b, t.c}, here);
        });
    }
}

JsonValue skinJson(const Skin& skin) {
    JsonValue weights = JsonValue::makeArray(), uvs = weights, offsets = weights, triangles = weights;
    bool anyUv = false, anyOffset = false;
    for (const SkinVertex& vertex : skin.vertices) {
        JsonValue pairs = JsonValue::makeArray();
        for (const SkinWeight& w : vertex.weights) {
            pairs.items.push_back(JsonValue::makeNumber(w.vertex));
            pairs.items.push_back(JsonValue::makeNumber(w.weight));
        }
        weights.items.push_back(std::move(pairs));
        uvs.items.push_back(JsonValue::makeVector(vertex.uv));
        offsets.items.push_back(JsonValue::makeNumber(vertex.offset));
        anyUv = anyUv || vertex.uv != glm::dvec2(0);
        anyOffset = anyOffset || vertex.offset != 0;
    }
    for (const SkinTriangle& t : skin.triangles)
        triangles.items.push_back(JsonValue::makeVector(glm::dvec3(t.a, t.b, t.c)));
    JsonValue out = JsonValue::makeObject();
    out.add("weights", std::move(weights));
    if (anyUv) out.add("uvs", std::move(uvs));
    if (anyOffset) out.add("offsets", std::move(offsets));
    out.add("triangles", std::move(triangles));
    return out;
}

}  // namespace shoal
