// Builds JSON from names and values:
//   return object(key("name", one.name), key("size", one.size), key("error", one.error));
#pragma once

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/json.h"

namespace shoal {

// Numbers, texts, flags, vectors and JSON as what they are; an optional that holds nothing as null; a
// std::vector as an array.
template <typename T>
JsonValue toJson(const T& value) {
    if constexpr (std::is_same_v<T, JsonValue>) {
        return value;
    } else if constexpr (std::is_same_v<T, bool>) {
        return JsonValue::makeBoolean(value);
    } else if constexpr (std::is_integral_v<T>) {
        // never with an exponent, which some readers of whole numbers do not take
        JsonValue out = JsonValue::makeNumber(double(value));
        out.text = std::to_string(value);
        return out;
    } else if constexpr (std::is_arithmetic_v<T>) {
        return JsonValue::makeNumber(double(value));
    } else if constexpr (std::is_convertible_v<const T&, std::string>) {
        return JsonValue::makeString(value);
    } else if constexpr (requires { value.has_value(); }) {
        return value ? toJson(*value) : JsonValue();
    } else if constexpr (requires { value.begin(); }) {
        JsonValue out = JsonValue::makeArray();
        for (const auto& element : value)
            out.items.push_back(toJson(element));
        return out;
    } else {
        return JsonValue::makeVector(value);
    }
}

// A member of an object, and an object of some of them.
template <typename T>
JsonMember key(const char* name, const T& value) {
    return {name, toJson(value)};
}
template <typename... Members>
JsonValue& append(JsonValue& object, Members... members) {
    (object.members.push_back(std::move(members)), ...);
    return object;
}
template <typename... Members>
JsonValue object(Members... members) {
    JsonValue out = JsonValue::makeObject();
    return append(out, std::move(members)...);
}

// The JSON of each, in an array.
template <typename T>
JsonValue arrayOf(const std::vector<T>& items, JsonValue (*json)(const std::type_identity_t<T>&)) {
    JsonValue out = JsonValue::makeArray();
    for (const T& item : items)
        out.items.push_back(json(item));
    return out;
}

// ---- Changes of what there is

// In place of what an object says of the key, if anything.
void setMember(JsonValue& object, const std::string& key, JsonValue value);
void leaveOut(JsonValue& object, const std::string& key);
// The object that another says of the key; an empty one is added where it says none.
JsonValue& memberOf(JsonValue& object, const std::string& key);
std::vector<double> numbersOf(const JsonValue& value);  // of one or of a list; none: it is something else

}  // namespace shoal
