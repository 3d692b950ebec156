#include <algorithm>
#include <cmath>

#include "core/describe.h"
#include "molecule/molecule_file.h"
#include "molecule/molecule_json.h"
#include "molecule/skin.h"

namespace shoal {

namespace {

constexpr double mostValue = 1e6;  // of weights, uvs and offsets
constexpr double mostSumError = 1e-5;

using Kind = JsonValue::Kind;

void checkIndex(double number, size_t count, const char* what, const Where& where) {
    if (!(number >= 0 && number < double(count) && number == std::floor(number)))
        throw Error(where.here(), "expected the index of a vertex of ", what, ", 0 to ", int64_t(count) - 1,
                    ", found ", number);
}

// Checks the count of a file's numbers for a skin vertex: pairs of a vertex and its weight.
void checkWeightCount(size_t numbers, const Where& where) {
    if (numbers == 0 || numbers % 2 != 0 || numbers > 2 * Skin::mostWeights)
        throw Error(where.here(), "expected 1 to ", Skin::mostWeights,
                    " pairs of a vertex and its weight, found ", numbers, " numbers");
}

void checkWeights(const SkinVertex& vertex, const Where& where) {
    double sum = 0;
    for (size_t k = 0; k < vertex.weights.size(); ++k) {
        for (size_t other = 0; other < k; ++other)
            if (vertex.weights[other].vertex == vertex.weights[k].vertex)
                throw Error(where.here(), "vertex ", vertex.weights[k].vertex,
                            " has two weights: add them up");
        sum += vertex.weights[k].weight;
    }
    if (!(std::abs(sum - 1) <= mostSumError))
        throw Error(where.here(), "expected weights that add up to 1, found ", sum);
}

bool isLarge(double number) {
    return !(std::abs(number) <= mostValue);
}

Error tooLarge(double number, const Location& where) {
    return Error(where, "expected a number from ", -mostValue, " to ", mostValue, ", found ", number);
}

void checkNumber(double number, const Where& where) {
    if (isLarge(number)) throw tooLarge(number, where.here());
}

void checkOffset(const SkinVertex& vertex, const Molecule& molecule, const Where& where) {
    if (vertex.offset != 0 && molecule.triangles.empty())
        throw Error(where.here(), "an offset is along the normal of the molecule, which has no triangles");
}

// ---- Reading

using Elements = std::vector<JsonValue>;

void needKind(const JsonValue& value, Kind kind, const char* what, const Where& where) {
    if (value.kind != kind) throw Error(where.here(), "expected ", what, ", found ", name(value.kind));
}

// The elements of a key's array; null where the key is absent.
const Elements* elementsOf(JsonReader& skin, const char* key, size_t most) {
    const JsonValue* array = skin.raw(key);
    if (!array) return nullptr;
    const Where where(skin);
    needKind(*array, Kind::array, "an array", where.in(key));
    needAtMost(where, key, array->items.size(), most);
    return &array->items;
}

const Elements& numbersOf(const JsonValue& element, const Where& where) {
    needKind(element, Kind::array, "an array of numbers", where);
    for (size_t k = 0; k < element.items.size(); ++k)
        needKind(element.items[k], Kind::number, "a number", where.element(k));
    return element.items;
}

void readWeights(JsonReader& reader, Skin& skin, const Molecule* molecule) {
    const Elements& weights = *elementsOf(reader, "weights", maxSkinVertices);
    const Where where(reader);
    for (size_t i = 0; i < weights.size(); ++i) {
        const Where here = where.in("weights", i);
        const Elements& numbers = numbersOf(weights[i], here);
        checkWeightCount(numbers.size(), here);
        SkinVertex vertex;
        for (size_t k = 0; k < numbers.size(); k += 2) {
            checkIndex(numbers[k].number, molecule->vertices.size(), "the molecule", here.element(k));
            checkNumber(numbers[k + 1].number, here.element(k + 1));
            vertex.weights.push_back({int(numbers[k].number), numbers[k + 1].number});
        }
        checkWeights(vertex, here);
        skin.vertices.push_back(std::move(vertex));
    }
}

void checkCount(const Elements& elements, size_t count, const Location& where) {
    if (elements.size() != count)
        throw Error(where, "expected one for each of the skin's ", count, " weights, found ",
                    elements.size());
}

void readUvs(JsonReader& reader, Skin& skin, const Molecule*) {
    const Elements* uvs = elementsOf(reader, "uvs", maxSkinVertices);
    if (!uvs) return;
    const Where where(reader);
    checkCount(*uvs, skin.vertices.size(), where.locate("uvs"));
    for (size_t i = 0; i < uvs->size(); ++i) {
        const Where here = where.in("uvs", i);
        const Elements& pair = numbersOf((*uvs)[i], here);
        if (pair.size() != 2) throw Error(here.here(), "expected an array of 2 numbers, found ", pair.size());
        for (size_t k = 0; k < 2; ++k) {
            const double number = skin.vertices[i].uv[int(k)] = pair[k].number;
            if (!isLarge(number)) continue;
            Location place = here.element(k).here();
            place.path = here.here().path;
            throw tooLarge(number, place);
        }
    }
}

void readOffsets(JsonReader& reader, Skin& skin, const Molecule* molecule) {
    const Elements* offsets = elementsOf(reader, "offsets", maxSkinVertices);
    if (!offsets) return;
    const Where where(reader);
    checkCount(*offsets, skin.vertices.size(), where.locate("offsets"));
    for (size_t i = 0; i < offsets->size(); ++i) {
        const Where here = where.in("offsets", i);
        const JsonValue& offset = (*offsets)[i];
        needKind(offset, Kind::number, "a number", here);
        checkNumber(offset.number, here);
        skin.vertices[i].offset = offset.number;
        checkOffset(skin.vertices[i], *molecule, here);
    }
}

void readSkinTriangles(JsonReader& reader, Skin& skin, const Molecule*) {
    const Elements& triangles = *elementsOf(reader, "triangles", maxSkinTriangles);
    const Where where(reader);
    if (triangles.empty())
        throw Error(where.locate("triangles"), "expected at least one triangle, found none");
    for (size_t i = 0; i < triangles.size(); ++i) {
        const Where here = where.in("triangles", i);
        const Elements& corners = numbersOf(triangles[i], here);
        if (corners.size() != 3)
            throw Error(here.here(), "expected an array of 3 numbers, found ", corners.size());
        int index[3];
        for (size_t k = 0; k < 3; ++k) {
            checkIndex(corners[k].number, skin.vertices.size(), "the skin", here.element(k));
            index[k] = int(corners[k].number);
        }
        checkCorners({index[0], index[1], index[2]}, here);
        skin.triangles.push_back({index[0], index[1], index[2]});
    }
}

// ---- Writing

template <typename Element, typename ToJson>
JsonValue listOf(const std::vector<Element>& elements, const ToJson& toJson) {
    JsonValue out = JsonValue::makeArray();
    for (const Element& element : elements)
        out.items.push_back(toJson(element));
    return out;
}

JsonValue writeWeights(const Skin& skin, const void*) {
    return listOf(skin.vertices, [](const SkinVertex& vertex) {
        JsonValue pairs = JsonValue::makeArray();
        for (const SkinWeight& w : vertex.weights) {
            pairs.items.push_back(JsonValue::makeNumber(w.vertex));
            pairs.items.push_back(JsonValue::makeNumber(w.weight));
        }
        return pairs;
    });
}

JsonValue writeUvs(const Skin& skin, const void*) {
    const auto has = [](const SkinVertex& vertex) { return vertex.uv != glm::dvec2(0); };
    if (std::none_of(skin.vertices.begin(), skin.vertices.end(), has)) return {};
    return listOf(skin.vertices, [](const SkinVertex& vertex) { return JsonValue::makeVector(vertex.uv); });
}

JsonValue writeOffsets(const Skin& skin, const void*) {
    const auto has = [](const SkinVertex& vertex) { return vertex.offset != 0; };
    if (std::none_of(skin.vertices.begin(), skin.vertices.end(), has)) return {};
    return listOf(skin.vertices,
                  [](const SkinVertex& vertex) { return JsonValue::makeNumber(vertex.offset); });
}

JsonValue writeSkinTriangles(const Skin& skin, const void*) {
    return listOf(skin.triangles,
                  [](const SkinTriangle& t) { return JsonValue::makeVector(glm::dvec3(t.a, t.b, t.c)); });
}

}  // namespace

const Description& describeSkin() {
    using Value = Form::Value;
    const Form::List vertices{.most = maxSkinVertices};
    static const Description description =
        Describe<Skin>("skin",
                       "A finer mesh that is drawn instead of the triangles and moves with the vertices.")
            .byHand<const Molecule>(
                "weights", {.value = Value::number, .lists = {vertices, {2, size_t(2 * Skin::mostWeights)}}},
                {"list of [vertex, weight, ...]",
                 "For each vertex of the skin, at most 262,144: a vertex of the molecule and its weight, up "
                 "to 8 times; the "
                 "weights add up to 1, and may be below 0."},
                readWeights, writeWeights)
            .needed()
            .byHand<const Molecule>("uvs", {.value = Value::number, .lists = {vertices, {2, 2}}},
                                    {"list of [u, v]", "Texture coordinates, as many."}, readUvs, writeUvs)
            .usually("all [0, 0]")
            .byHand<const Molecule>("offsets", {.value = Value::number, .lists = {vertices}},
                                    {"list of numbers, m",
                                     "How far each stands off along the molecule's normal, as many; only "
                                     "with `triangles` of the molecule."},
                                    readOffsets, writeOffsets)
            .usually("all 0")
            .byHand<const Molecule>(
                "triangles",
                {.value = Value::whole, .lists = {{1, maxSkinTriangles}, {3, 3}}, .range = Range::atLeast(0)},
                {"list of [a, b, c]",
                 "Three vertices of the skin each, anticlockwise seen from the front, 1 to 524,288."},
                readSkinTriangles, writeSkinTriangles)
            .needed();
    return description;
}

void readSkin(JsonReader& root, Molecule& molecule) {
    auto reader = root.object("skin");
    if (!reader) return;
    Skin skin;
    describeSkin().read(*reader, skin, &molecule);
    reader->finish();
    molecule.skin = std::move(skin);
    placeSkin(molecule);
}

void checkSkin(const Molecule& molecule, const Where& where) {
    const Skin& skin = molecule.skin;
    needAtMost(where, "weights", skin.vertices.size(), maxSkinVertices);
    needAtMost(where, "triangles", skin.triangles.size(), maxSkinTriangles);
    for (size_t i = 0; i < skin.vertices.size(); ++i) {
        const SkinVertex& vertex = skin.vertices[i];
        const Where weights = where.in("weights", i), uvs = where.in("uvs", i),
                    offsets = where.in("offsets", i);
        checkWeightCount(2 * vertex.weights.size(), weights);
        for (const SkinWeight& weight : vertex.weights) {
            checkIndex(weight.vertex, molecule.vertices.size(), "the molecule", weights);
            checkNumber(weight.weight, weights);
        }
        checkWeights(vertex, weights);
        checkNumber(vertex.uv.x, uvs);
        checkNumber(vertex.uv.y, uvs);
        checkNumber(vertex.offset, offsets);
        checkOffset(vertex, molecule, offsets);
    }
    for (size_t i = 0; i < skin.triangles.size(); ++i) {
        const SkinTriangle& t = skin.triangles[i];
        for (const int corner : {t.a, t.b, t.c})
            checkIndex(corner, skin.vertices.size(), "the skin", where.in("triangles", i));
        checkCorners({t.a, t.b, t.c}, where.in("triangles", i));
    }
}

}  // namespace shoal
