// Numbers and arrays as GLSL.
#pragma once

#include <charconv>
#include <string>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

// The shortest text of a float that reads back as the same float, and as a float in GLSL.
inline std::string glslLiteral(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, float(value)).ptr;
    std::string out(text, end);
    if (out.find_first_of(".en") == std::string::npos) out += ".0";
    return out;
}

inline std::string glslLiteral(const glm::dvec3& v) {
    return concat("vec3(", glslLiteral(v.x), ", ", glslLiteral(v.y), ", ", glslLiteral(v.z), ")");
}

// const float name[VERTICES] = float[](...); `value`: the text of element i
template <typename Value>
std::string glslArray(const char* type, const char* name, size_t count, Value value) {
    std::string out = concat("const ", type, " ", name, "[VERTICES] = ", type, "[](");
    for (size_t i = 0; i < count; ++i)
        out += (i == 0 ? "" : ", ") + value(i);
    return out + ");\n";
}

}  // namespace shoal
