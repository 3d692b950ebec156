#include "molecule/skin_file.h"

#include <algorithm>
#include <cmath>

namespace shoal {

namespace {

constexpr double mostValue = 1e6;  // of weights, uvs and offsets
constexpr double mostSumError = 1e-5;

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
        if (std::abs(value.number) > mostValue)
            throw Error(at(value, path), concat("expected a number from ", -mostValue, " to ", mostValue,
                                                ", found ", value.number));
        return value.number;
    }
    int index(const JsonValue& value, const std::string& path, size_t count, const char* of) const {
        if (!(value.number >= 0 && value.number < double(count)) || value.number != std::floor(value.number))
            throw Error(at(value, path), concat("expected the index of a vertex of ", of, ", 0 to ",
                                                int64_t(count) - 1, ", found ", value.number));
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
        if (numbers.empty() || numbers.size() % 2 != 0 || numbers.size() > 2 * Skin::mostWeights)
            throw Error(
                here, concat("expected 1 to ", Skin::mostWeights, " pairs of a vertex and its weight, found ",
                             numbers.size(), " numbers"));
        SkinVertex vertex;
        double sum = 0;
        for (size_t k = 0; k < numbers.size(); k += 2) {
            SkinWeight weight;
            weight.vertex = weights.index(numbers[k], concat(weights.path(i), "[", k, "]"),
                                          molecule.vertices.size(), "the molecule");
            weight.weight = weights.number(numbers[k + 1], concat(weights.path(i), "[", k + 1, "]"));
            for (const SkinWeight& other : vertex.weights)
                if (other.vertex == weight.vertex)
                    throw Error(here, concat("vertex ", weight.vertex, " has two weights: add them up"));
            sum += weight.weight;
            vertex.weights.push_back(weight);
        }
        if (!(std::abs(sum - 1) <= mostSumError))
            throw Error(here, concat("expected weights that add up to 1, found ", sum));
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
        if (skin.vertices[i].offset != 0 && molecule.triangles.empty())
            throw Error(offsets.at(offsets[i], offsets.path(i)),
                        "an offset is along the normal of the molecule, which has no triangles");
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
        if (index[0] == index[1] || index[1] == index[2] || index[2] == index[0])
            throw Error(here, concat("a triangle needs three different vertices, found ", index[0], ", ",
                                     index[1], ", ", index[2]));
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
