// Values of several numbers in JSON: directions, rotations, boxes, spans and colours. The getters leave `out`
// alone and return false where the key is absent; the checks throw an Error at `where`.
#pragma once

#include <string>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/box.h"
#include "core/json.h"

namespace shoal {

// The limits of what must be above 0: in single precision smaller numbers are as good as 0.
constexpr double leastPositive = 1e-9;
inline Range aboveZero() {
    return Range::atLeast(leastPositive);
}

// A quaternion [x, y, z, w] (glTF's order), or {"axis": [x, y, z], "angle": rad}.
bool getRotation(JsonReader& reader, const std::string& key, glm::dquat& out);
void checkRotation(const glm::dquat& q, const Location& where);

// A vector of any length above 0; `out` becomes its direction.
bool getDirection(JsonReader& reader, const std::string& key, glm::dvec3& out);
void checkDirection(const glm::dvec3& v, const Location& where);

// {"low": [x, y, z], "high": [x, y, z]}, low below high (or equal where `flat`); `where`: of "high".
bool getBox(JsonReader& reader, const std::string& key, Box& out, bool flat = false);
void checkBox(const Box& box, bool flat, const Location& where);
JsonValue writeBox(const Box& box);

// A number, or [least, most].
bool getSpan(JsonReader& reader, const std::string& key, glm::dvec2& out, Range range);
void checkSpan(const glm::dvec2& span, const Location& where);

}  // namespace shoal
