// Predicts a picture of blended squares from pictures of each alone: blending in closed form.
#pragma once

#include <cmath>
#include <vector>

#include "gl/render_scene.h"

namespace shoal::test {

// Returns what the picture shows of a channel's radiance (shaders/render/tone.glsl), from 0 to 255.
inline double shownOf(double radiance) {
    const double x = radiance * 0.5;
    const double y = std::clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    return 255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1 / 2.4) - 0.055);
}

// The inverse, by bisection: shownOf() grows.
inline double radianceOf(double shown) {
    double low = 0, high = 100;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (shownOf(middle) < shown ? low : high) = middle;
    }
    return low;
}

inline glm::dvec3 radianceOf(const glm::ivec3& pixel) {
    return {radianceOf(pixel.x), radianceOf(pixel.y), radianceOf(pixel.z)};
}

inline glm::dvec3 shownOf(const glm::dvec3& radiance) {
    return {shownOf(radiance.x), shownOf(radiance.y), shownOf(radiance.z)};
}

// A picture's pixels have 8 bits and half a step of dither; so have those that the expectation came from.
inline double farthest(const glm::ivec3& found, const glm::dvec3& expected) {
    const glm::dvec3 d = glm::abs(glm::dvec3(found) - expected);
    return std::max({d.x, d.y, d.z});
}

}  // namespace shoal::test
