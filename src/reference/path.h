// The way of a vertex within a step.
#pragma once

#include <glm/glm.hpp>

namespace shoal::reference {

// The cubic through both ends of a step with their velocities.
struct Path {
    glm::dvec3 x0, v0, x1, v1;  // v in m per step
    glm::dvec3 at(double s) const {
        const double r = 1 - s;
        return x0 * (r * r * (1 + 2 * s)) + x1 * (s * s * (1 + 2 * r)) + v0 * (s * r * r) - v1 * (s * s * r);
    }
    double length() const { return glm::length(x1 - x0); }
    double bend() const {
        return (glm::length(v0) + glm::length(v1)) * (4 / 27.0);
    }  // at most, off the chord
};

}  // namespace shoal::reference
