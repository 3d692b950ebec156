// Contact of spheres in double precision, by brute force: the same equations as shaders/physics/pair.glsl and
// shaders/contact/respond.glsl (docs/contact.md), written for themselves.
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

// All that overlap, of different molecules: first below second. O(n^2).
std::vector<std::pair<int, int>> touching(const std::vector<Sphere>& spheres);

struct SphereResponse {
    double stepTime = 0;   // s, since the last contact step
    double restSpeed = 0;  // m/s: slower is rest
    double restitution = 0.2, friction = 0.5;
    int iterations = 4;
};

// Moves the spheres apart and changes their velocities, all contacts at once.
void respond(std::vector<Sphere>& spheres, const std::vector<std::pair<int, int>>& contacts,
             const SphereResponse& settings);

}  // namespace shoal::reference
