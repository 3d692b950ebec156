// Values as USD's text has them.
#pragma once

#include <charconv>
#include <string>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace shoal::exchange::usda {

inline void put(std::string& out, double value) {
    char digits[40];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
inline void put(std::string& out, float value) {
    char digits[32];
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}
inline void put(std::string& out, uint32_t value) {
    out += std::to_string(value);
}
// Places in single precision, as USD has them.
inline void put(std::string& out, const glm::dvec3& v) {
    out += '(';
    for (int i = 0; i < 3; ++i) {
        if (i > 0) out += ',';
        put(out, float(v[i]));
    }
    out += ')';
}
inline void put(std::string& out, const glm::vec3& v) {
    put(out, glm::dvec3(v));
}
inline void put(std::string& out, const glm::vec2& v) {
    out += '(';
    put(out, v.x);
    out += ',';
    put(out, v.y);
    out += ')';
}
// The real part first.
inline void put(std::string& out, const glm::quat& q) {
    out += '(';
    put(out, q.w);
    for (const float part : {q.x, q.y, q.z}) {
        out += ',';
        put(out, part);
    }
    out += ')';
}

template <typename Values>
std::string list(const Values& values) {
    std::string out = "[";
    for (const auto& value : values) {
        if (out.size() > 1) out += ',';
        put(out, value);
    }
    return out + "]";
}

template <typename T>
std::string text(const T& value) {
    std::string out;
    put(out, value);
    return out;
}

}  // namespace shoal::exchange::usda
