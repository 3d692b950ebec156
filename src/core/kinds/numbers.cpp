// One number or several.
#include <algorithm>
#include <type_traits>

#include "core/kinds/parts.h"

namespace shoal {

namespace {

using Tells = KeyKind::Tells;

double nearestAllowed(double wanted, const Key& key) {
    return std::clamp(wanted, key.says.range.least, key.says.range.most);
}

// ---- N numbers, each within the limits of the key

template <int N, typename Number>
using Numbers = std::conditional_t<N == 1, Number, glm::vec<N, Number>>;

template <int N, typename Number>
void checkNumbers(const Key& key, const void* value, const Where& where, double largest) {
    const auto* numbers = static_cast<const Number*>(value);
    const Range& range = key.says.range;
    if (N == 1 && key.unlessZero && numbers[0] == 0) return;
    for (int i = 0; i < N; ++i)
        if (!(std::abs(double(numbers[i])) <= largest && contains(range, numbers[i])))
            checkNumber(N == 1 ? key.name : concat(key.name, "[", i, "]"), numbers[i], range, where, largest);
}

template <int N, typename Number>
JsonValue leastNumbers(const Key& key, const TextOf&) {
    return toJson(Numbers<N, Number>(Number(nearestAllowed(1, key))));
}

template <int N, typename Number>
JsonValue schemaOfNumbers(const Key& key, const SchemaOf&) {
    const Range& range = key.says.range;
    const bool limited = std::isfinite(range.least) || std::isfinite(range.most);
    if (key.kind->definition && !limited) return schemaReference(key.kind->definition);
    const char* type = std::is_integral_v<Number> ? "integer" : "number";
    return N == 1 ? numberSchema(type, range) : numbersSchema(N, range, type);
}

// Completes a kind.
template <int N, typename Number>
constexpr KeyKind numbersKind(KeyKind kind) {
    using T = Numbers<N, Number>;
    if (std::is_integral_v<Number>) kind.form = RowForm::wholes;
    if (!kind.read) kind.read = readValue<T>;
    if (!kind.check) kind.check = checkNumbers<N, Number>;
    if (!kind.write) kind.write = writeValue<T>;
    if (!kind.least) kind.least = leastNumbers<N, Number>;
    if (!kind.schema) kind.schema = schemaOfNumbers<N, Number>;
    kind.numbers = numbersIn<N, Number>;
    return kind;
}

bool getWhole3(const Key& key, JsonReader& reader, glm::ivec3& out) {
    std::vector<int> numbers;
    if (!getPlain(key, reader, numbers)) return false;
    if (numbers.size() != 3)
        throw Error(reader.locate(key.name), "expected three whole numbers, found ", numbers.size());
    out = {numbers[0], numbers[1], numbers[2]};
    return true;
}

// ---- Two numbers, or one that stands for both

bool isSingle(const Key& key, JsonReader& reader) {
    const JsonValue* given = reader.raw(key.name);
    return given && given->kind == JsonValue::Kind::number;
}

void checkOrder(const glm::dvec2& span, const Location& where) {
    if (span.x > span.y) throw Error(where, "expected [least, most], found ", span.x, " above ", span.y);
}

bool getSpan(const Key& key, JsonReader& reader, glm::dvec2& out) {
    if (isSingle(key, reader)) {
        reader.get(key.name, out.x, key.says.range);
        out.y = out.x;
        return true;
    }
    if (!getPlain(key, reader, out)) return false;
    checkOrder(out, reader.locate(key.name));
    return true;
}

void checkSpan(const Key& key, const void* value, const Where& where, double largest) {
    checkNumbers<2, double>(key, value, where, largest);
    checkOrder(held<glm::dvec2>(value), where.locate(key.name));
}

JsonValue spanJson(const glm::dvec2& span) {
    return span.x == span.y ? toJson(span.x) : toJson(span);
}

bool getEnds(const Key& key, JsonReader& reader, glm::dvec2& out) {
    return isSingle(key, reader) ? reader.get(key.name, out.y, key.says.range) : getPlain(key, reader, out);
}

JsonValue writeEnds(const Key&, const void* value, const void* usual, const void*) {
    const glm::dvec2& ends = held<glm::dvec2>(value);
    if (!usual || ends.x != held<glm::dvec2>(usual).x) return toJson(ends);
    return ends.y == held<glm::dvec2>(usual).y ? JsonValue() : toJson(ends.y);
}

JsonValue pairSchema(const Key& key, const SchemaOf&) {
    return eitherSchema(numberSchema("number", key.says.range), numbersSchema(2, key.says.range));
}

// ---- Directions and colours

bool getDirection(const Key& key, JsonReader& reader, glm::dvec3& out) {
    if (!getPlain(key, reader, out)) return false;
    out = normalized(out, reader.locate(key.name));
    return true;
}

void checkDirection(const Key& key, const void* value, const Where& where, double largest) {
    checkNumbers<3, double>(key, value, where, largest);
    normalized(held<glm::dvec3>(value), where.locate(key.name));
}

JsonValue colorSchema(const Key& key, const SchemaOf&) {
    return std::isfinite(key.says.range.most) ? numbersSchema(3, key.says.range) : schemaReference("color");
}

template <typename T>
constexpr KeyKind seedKind(const char* name) {
    return {.name = name,
            .form = RowForm::wholes,
            .read = readValue<T>,
            .write = writeValue<T>,
            .least = [](const Key&, const TextOf&) { return toJson(1); },
            .schema =
                [](const Key&, const SchemaOf&) {
                    return numberSchema("integer",
                                        sizeof(T) == 4 ? Range::between(0, 4294967295.0) : Range::atLeast(0));
                }};
}

}  // namespace

const KeyKind KeyKind::number =
    numbersKind<1, double>({.name = "number", .tells = Tells::limits, .freeUsual = true});

const KeyKind KeyKind::whole = numbersKind<1, int>({.name = "whole number", .tells = Tells::limits});

const KeyKind KeyKind::whole3 = numbersKind<3, int>(
    {.name = "three whole numbers",
     .tells = Tells::limits,
     .read = readValue<glm::ivec3, getWhole3>,
     .least = [](const Key& key, const TextOf&) { return toJson(glm::ivec3(int(nearestAllowed(8, key)))); }});

const KeyKind KeyKind::seed = seedKind<uint32_t>("whole number from 0 to 4294967295");
const KeyKind KeyKind::longSeed = seedKind<uint64_t>("whole number of 64 bits");

const KeyKind KeyKind::vector2 =
    numbersKind<2, double>({.name = "two numbers", .tells = Tells::limits, .definition = "vector2"});

const KeyKind KeyKind::vector3 = numbersKind<3, double>(
    {.name = "[x, y, z]",
     .tells = Tells::limits,
     .definition = "vector",
     .sliderReach = 1000,
     .least = [](const Key& key, const TextOf&) {
         return toJson(glm::dvec3(key.says.range.least >= 0 ? nearestAllowed(1, key) : 0));
     }});

const KeyKind KeyKind::direction =
    numbersKind<3, double>({.name = "direction",
                            .form = RowForm::direction,
                            .definition = "direction",
                            .read = readValue<glm::dvec3, getDirection>,
                            .check = checkDirection,
                            .least = [](const Key&, const TextOf&) { return toJson(glm::dvec3(0, 1, 0)); }});

const KeyKind KeyKind::color =
    numbersKind<3, double>({.name = "colour", .form = RowForm::color, .schema = colorSchema});

const KeyKind KeyKind::span = numbersKind<2, double>({.name = "number or [least, most]",
                                                      .tells = Tells::limits,
                                                      .form = RowForm::span,
                                                      .freeUsual = true,
                                                      .read = readValue<glm::dvec2, getSpan>,
                                                      .check = checkSpan,
                                                      .write = writeValue<glm::dvec2, spanJson>,
                                                      .schema = pairSchema});

const KeyKind KeyKind::ends = numbersKind<2, double>({.name = "number or [first, last]",
                                                      .tells = Tells::limits,
                                                      .form = RowForm::span,
                                                      .read = readValue<glm::dvec2, getEnds>,
                                                      .write = writeEnds,
                                                      .schema = pairSchema});

}  // namespace shoal
