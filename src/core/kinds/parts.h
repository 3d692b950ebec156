// What kinds of keys are made of: values that a member holds as they are, and parts of JSON Schema.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/description.h"
#include "core/json_build.h"

namespace shoal {

template <typename T>
const T& held(const void* value) {
    return *static_cast<const T*>(value);
}

template <typename T>
bool getPlain(const Key& key, JsonReader& reader, T& out) {
    return reader.get(key.name, out, key.says.range);
}

// `get`: leaves its target alone where the file has not the key, and returns false. The value is read on its
// own before an optional member is made, which a file that says nothing leaves empty.
template <typename T, auto get = getPlain<T>>
void readValue(const Key& key, JsonReader& reader, void* object, void*) {
    const void* before = key.value(object);
    T value = before ? held<T>(before) : T();
    if (get(key, reader, value)) *static_cast<T*>(key.member.make(key.place(object))) = std::move(value);
}

template <typename T, auto json = toJson<T>>
JsonValue writeValue(const Key&, const void* value, const void* usual, const void*) {
    return usual && held<T>(value) == held<T>(usual) ? JsonValue() : json(held<T>(value));
}

// Error: beyond the limits, or further from 0 than `largest`.
template <typename Number>
void checkNumber(const std::string& path, Number value, Range range, const Where& where, double largest) {
    if (std::isfinite(value) && std::abs(double(value)) > largest)
        throw Error(where.locate(path), "expected a number within ", largest, " of 0, found ", value);
    if (!contains(range, value)) needWithin(where.locate(path), value, range);
}

template <int N, typename Number>
std::vector<double> numbersIn(const void* value) {
    const auto* first = static_cast<const Number*>(value);
    return {first, first + N};
}

// Error: of no length.
inline glm::dvec3 normalized(const glm::dvec3& v, const Location& where) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0) throw Error(where, "expected a direction of any length above 0, found zero");
    return glm::normalize(v / largest);  // the squares alone could overflow
}

// A definition at the end of the schema of a file.
inline JsonValue schemaReference(const char* definition) {
    return object(key("$ref", concat("#/$defs/", definition)));
}

inline JsonValue textSchema(bool notEmpty) {
    JsonValue out = object(key("type", "string"));
    return notEmpty ? out.add("minLength", toJson(1)) : out;
}

inline JsonValue numberSchema(const char* type, const Range& range) {
    JsonValue out = object(key("type", type));
    if (std::isfinite(range.least))
        out.add(range.aboveLeast ? "exclusiveMinimum" : "minimum", toJson(range.least));
    return std::isfinite(range.most) ? out.add("maximum", toJson(range.most)) : out;
}

inline JsonValue listSchema(JsonValue items, size_t least = 0,
                            size_t most = std::numeric_limits<size_t>::max()) {
    JsonValue out = object(key("type", "array"));
    if (least > 0) out.add("minItems", toJson(double(least)));
    if (most < std::numeric_limits<size_t>::max()) out.add("maxItems", toJson(double(most)));
    return out.add("items", std::move(items));
}

inline JsonValue numbersSchema(size_t count, const Range& range, const char* type = "number") {
    return listSchema(numberSchema(type, range), count, count);
}

inline JsonValue eitherSchema(JsonValue first, JsonValue second) {
    return object(key("anyOf", std::vector<JsonValue>{std::move(first), std::move(second)}));
}

}  // namespace shoal
