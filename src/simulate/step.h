// A frame in the numbers that all paths hand to their shaders, and those of them that can be changed while a
// simulation runs: no change of these compiles a shader or moves state.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "compile/plan.h"

namespace shoal {

// Controls one force of the scene.
struct ForceControl {
    bool on = true;                      // those of the mouse act only while told to
    double factor = 1;                   // on its strength, on top of its path's
    std::optional<glm::dvec3> position;  // m, in place of its own and its path's
    bool operator==(const ForceControl&) const = default;
};

struct Parameters {
    glm::dvec3 gravity{0};                        // m/s^2
    double wind = 1;                              // factor on every field
    double drag = 1, stiffness = 1, damping = 1;  // factors on top of each group's own
    std::vector<ForceControl> forces;             // as many as the plan has
    std::vector<double> fields;                   // factors on the fields' weights; those left out: 1
    int substeps = 4;                             // per frame
    double frameTime = 1.0 / 60;                  // s
    bool operator==(const Parameters&) const = default;
};

// Returns the parameters as the scene has them, before any slider is moved.
Parameters parametersOf(const Plan& plan);
// Whether forces jump from one to the other. A force that is moved by hand makes no jump, only a
// corner in its path.
bool jumps(const Parameters& from, const Parameters& to);

struct Frame {
    double time = 0;  // s, at its start
    double end = 0;   // s, at its end, which is the next one's start to the bit
    double h = 0;     // s, a substep
    int number = 0;   // from 0
    Parameters parameters;
    bool restarts =
        false;  // the substep or the forces are not the last one's: solvers with history start anew
};

// Contact step i of a frame that contact between molecules cuts into `steps`.
Frame pieceOf(const Frame& frame, int i, int steps);

// Exact drag over h across (x) and along (y) the surface: decay = 1 - exp(-gamma h), phi = decay / gamma (h
// where gamma = 0); in double, where the difference to h still counts.
//
// Beyond gamma h = slipFrom (both rates) leapfrog does not follow the velocity on its way to the fluid's:
// decay = gamma h / (1 + gamma h), phi = h / (1 + gamma h), and the position drifts by the new velocity
// alone. Then v tends to the slip velocity u + (g - Du/Dt) / gamma, exactly where Du/Dt is steady, the way
// covered while it does is right, and springs move what they pull on by h f / (m gamma). The exact decay,
// split from the drift, lags by h/2.
struct DragCoefficients {
    glm::vec2 decay{0}, phi{0};
    bool slips = false;
    glm::vec2 bend{0};  // (h - phi) / gamma, s^2: how far an acceleration now carries in the step
};
DragCoefficients dragCoefficients(const GroupPlan& group, const Parameters& parameters, double h);

// Holds the drag inside a stage of BDF2 (shaders/fused/bdf2.glsl), eta = 2h/3: decay = gamma eta / (1 + gamma
// eta), phi = eta / (1 + gamma eta).
struct StageCoefficients {
    float eta = 0;  // s
    DragCoefficients drag;
};
StageCoefficients stageCoefficients(const GroupPlan& group, const Parameters& parameters, double h);

// Tells when pins are released in a frame.
struct ReleaseLimits {
    float force = 0;   // N, above which they are
    float chance = 0;  // in this frame
};
ReleaseLimits releaseLimits(const GroupPlan& group, const Frame& frame);

// Returns the numbers of the fields, with the weights and the times of the frame.
std::vector<glm::vec4> fieldParameters(const Plan& plan, const Frame& frame);

// Returns the numbers of a group's colliders, where these are in the frame.
std::vector<glm::vec4> colliderParameters(const Plan& plan, const GroupPlan& group, const Frame& frame);

// The numbers of the forces on a group, for the text of compile/generate_forces.h. A path and a change by
// hand are taken in the middle of the frame, and hold over it: an error of second order in the frame.
// (Solvers with history ask for forces at the ends of their substeps, and get the middle of those.)
//
// From its slot on, a force has the numbers of its call (compile/call_writer.h), and a thrust has exp(rate
// h), exp(rate h / 2), limit and rate. The sum of the winds comes last. The strength of a force that is
// switched off is 0.
std::vector<glm::vec4> forceParameters(const Plan& plan, const GroupPlan& group, const Frame& frame);

// Step, kickDrift and lag of shaders/physics/collide.glsl.
glm::vec3 driftOf(SolverKind solver, double h, bool slips);

}  // namespace shoal
