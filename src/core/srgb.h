// The curve of sRGB (IEC 61966-2-1), both ways; numbers in [0, 1].
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace shoal {

inline double linearOfSrgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline glm::dvec3 linearOfSrgb(const glm::dvec3& c) {
    return {linearOfSrgb(c.r), linearOfSrgb(c.g), linearOfSrgb(c.b)};
}

inline double srgbOfLinear(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

}  // namespace shoal
