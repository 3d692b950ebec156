// The kinds of forces. Each says what a path's factor multiplies (`times`), how fast it makes things turn or
// grow (`fastestRate`), and, where it depends on the place, the call of its function in
// shaders/physics/force.glsl. Its double-precision twin is in reference/forces.cpp. docs/adding-a-force.md
// says how to add one. SI units.
#pragma once

#include <cmath>
#include <variant>

#include "scene/force.h"
#include "scene/glsl_call.h"

namespace shoal {

// Towards a point, or away from it where the strength is negative. With d the distance:
//   inverseSquare   strength / d^2 (m^3/s^2), at most `most`       constant   strength (m/s^2)
// Nothing beyond `radius`, and nothing at the point itself.
struct AttractForce {
    enum class Falloff { inverseSquare, constant };
    glm::dvec3 position{0};
    Falloff falloff = Falloff::inverseSquare;
    double strength = 1;
    double radius = 0;  // m; 0: no end (inverseSquare only)
    double most = 0;    // m/s^2; inverseSquare, above 0
    AttractForce times(double factor) const;
    double fastestRate() const;
    GlslCall call() const;
};

// Towards the closest point of a line, and around it [Latta 2004, section 3.4.2], within a radius: both grow
// with the distance up to the core and fall off beyond it as core / distance.
struct VortexLineForce {
    glm::dvec3 position{0};
    glm::dvec3 axis{0, 1, 0};  // unit
    double pull = 1;           // m/s^2 at the core, towards the line
    double turn = 1;           // m/s^2 at the core, around it by the right-hand rule
    double core = 0.5;         // m, above 0
    double radius = 0;         // m; 0: no end
    VortexLineForce times(double factor) const;
    double fastestRate() const;
    GlslCall call() const;
};

// Along the velocity: dv/dt = rate v while the speed is below the limit, which a rate above 0 does not pass
// (un-damping, Latta: what propels itself). A rate below 0 damps at any speed. A molecule of several vertices
// is pushed as a whole: v is the mean velocity by mass, with what pins hold as at rest, and its vibrations
// neither grow nor fade by it.
struct ThrustForce {
    double rate = 1;   // 1/s
    double limit = 1;  // m/s, above 0
    ThrustForce times(double factor) const { return {rate * factor, limit}; }
    double fastestRate() const { return std::abs(rate); }
};

// Adds to the fluid's velocity everywhere: moves what has drag.
struct WindForce {
    glm::dvec3 velocity{0};  // m/s
    WindForce times(double factor) const { return {factor * velocity}; }
    double fastestRate() const { return 0; }
};

struct ForceShape : std::variant<AttractForce, VortexLineForce, ThrustForce, WindForce> {
    using variant::variant;
};

const Description& describe(const AttractForce*);
const Description& describe(const VortexLineForce*);
const Description& describe(const ThrustForce*);
const Description& describe(const WindForce*);

}  // namespace shoal
