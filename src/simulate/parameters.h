// Holds the numbers that can be changed while a simulation runs. Nothing here compiles a shader or moves
// state.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

struct Plan;

// Controls one force of the scene.
struct ForceControl {
    bool on = true;                      // those of the mouse act only while told to
    double factor = 1;                   // on its strength, on top of its path's
    std::optional<glm::dvec3> position;  // m, in place of its own and its path's
};

struct Parameters {
    glm::dvec3 gravity{0};                        // m/s^2
    double wind = 1;                              // factor on every field
    double drag = 1, stiffness = 1, damping = 1;  // factors on top of each group's own
    std::vector<ForceControl> forces;             // as many as the plan has
    std::vector<double> fields;                   // factors on the fields' weights; those left out: 1
    int substeps = 4;                             // per frame
    double frameTime = 1.0 / 60;                  // s
};

// As the scene has them: no slider moved.
Parameters parametersOf(const Plan& plan);
// Whether forces jump from one to the other. What a hand moves goes on, if with corners.
bool jumps(const Parameters& from, const Parameters& to);

}  // namespace shoal
