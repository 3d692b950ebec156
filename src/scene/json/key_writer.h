// Writes the keys of one object of a scene file. Used by *_writer.cpp only.
#pragma once

#include <string>
#include <utility>

#include "core/json.h"

namespace shoal {

class KeyWriter {
  public:
    JsonValue object = JsonValue::makeObject();

    void value(const char* key, JsonValue value) { object.add(key, std::move(value)); }
    void word(const char* key, const std::string& word) { object.add(key, JsonValue::makeString(word)); }
    // What is not as where the key is left out.
    void number(const char* key, double number, double unless) {
        if (number != unless) object.add(key, JsonValue::makeNumber(number));
    }
    void flag(const char* key, bool flag, bool unless) {
        if (flag != unless) object.add(key, JsonValue::makeBoolean(flag));
    }
    void vector(const char* key, const glm::dvec3& vector, const glm::dvec3& unless) {
        if (vector != unless) object.add(key, JsonValue::makeVector(vector));
    }
    // As getSpan reads it.
    void span(const char* key, const glm::dvec2& span, const glm::dvec2& unless) {
        if (span == unless) return;
        object.add(key, span.x == span.y ? JsonValue::makeNumber(span.x) : JsonValue::makeVector(span));
    }
};

}  // namespace shoal
