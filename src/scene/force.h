// Forces beside the fields: accelerations that depend on place and velocity (GLSL:
// shaders/physics/force.glsl). They add up.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

class Description;

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
};

// Along the velocity: dv/dt = rate v while the speed is below the limit, which a rate above 0 does not pass
// (un-damping, Latta: what propels itself). A rate below 0 damps at any speed. A molecule of several vertices
// is pushed as a whole: v is the mean velocity by mass, with what pins hold as at rest, and its vibrations
// neither grow nor fade by it.
struct ThrustForce {
    double rate = 1;   // 1/s
    double limit = 1;  // m/s, above 0
};

// Adds to the fluid's velocity everywhere: moves what has drag.
struct WindForce {
    glm::dvec3 velocity{0};  // m/s
};

using ForceShape = std::variant<AttractForce, VortexLineForce, ThrustForce, WindForce>;

// How a force moves and changes: between two keyframes in a straight line; it holds before the first and
// after the last, or starts over.
struct ForcePath {
    struct Keyframe {
        double time = 0;       // s
        glm::dvec3 offset{0};  // m, added to the position
        double factor = 1;     // on the strength: strength, pull and turn, rate, or velocity
    };
    std::vector<Keyframe> keyframes;  // at least two; their times rise
    bool repeats = false;
};

struct Force {
    std::string name;
    ForceShape shape;
    std::vector<std::string> groups;  // names; empty: all
    std::optional<ForcePath> path;
    bool mouse = false;  // follows the pointer in the window while a button is held, and acts only then
    Location location;
};

// Holds what a path adds to the position and multiplies the strength by, at a time (s). Without a path both
// stay as they are.
struct ForceMoment {
    glm::dvec3 offset{0};  // m
    double factor = 1;
};
ForceMoment momentOf(const std::optional<ForcePath>& path, double time);

// rad/s: the root of the steepest gradient of its acceleration, with the largest factor of its path; 1/s: the
// rate of a thrust; 0 of a wind. What it acts on neither turns nor grows faster.
double fastestRate(const Force& force);

const Description& describe(const AttractForce*);
const Description& describe(const VortexLineForce*);
const Description& describe(const ThrustForce*);
const Description& describe(const WindForce*);
const Description& describe(const ForcePath::Keyframe*);
const Description& describe(const ForcePath*);
const Description& describe(const Force*);

// Whether it stands somewhere; the others act alike everywhere.
bool hasPlace(const ForceShape& shape);

// Whether it is for the groups of that name.
bool actsOn(const Force& force, const std::string& group);

const char* kindName(const ForceShape& shape);  // its word in files

}  // namespace shoal
