// What can be changed while a simulation runs. Nothing here compiles a shader or moves state.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace shoal {

struct Plan;

struct Parameters {
    glm::dvec3 gravity{0};                        // m/s^2
    double wind = 1;                              // factor on every field
    double drag = 1, stiffness = 1, damping = 1;  // factors on top of each group's own
    int substeps = 4;                             // per frame
    double frameTime = 1.0 / 60;                  // s
};

// As the scene has them: no slider moved.
Parameters parametersOf(const Plan& plan);

}  // namespace shoal
