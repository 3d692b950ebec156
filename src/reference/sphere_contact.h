// Contact of spheres in double precision, by brute force. Their response: tests/reference/sphere_response.h.
#pragma once

#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace shoal::reference {

struct Sphere {
    glm::dvec3 position{0}, velocity{0};  // m, m/s
    double radius = 0;                    // m
    double weight = 1;                    // 1/kg: 1 / mass, 0 where held
    int molecule = 0;                     // spheres of one never touch
};

// All in contact (ContactPlan::near), of different molecules: first below second. O(n^2). Beside them those
// that approached `step` s ago and have touched since, as their velocities now tell.
std::vector<std::pair<int, int>> touching(const std::vector<Sphere>& spheres, double step = 0);

}  // namespace shoal::reference
