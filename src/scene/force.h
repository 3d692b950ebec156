// Forces beside the fields: accelerations that depend on place and velocity. They add up. The kinds:
// scene/force_kinds.h. SI units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/boxed.h"
#include "core/error.h"

namespace shoal {

class Description;

struct ForceShape;  // one of the kinds
extern template class Boxed<ForceShape>;

// How a force moves and changes: between two keyframes in a straight line; it holds before the first and
// after the last, or starts over.
struct ForcePath {
    struct Keyframe {
        double time = 0;       // s
        glm::dvec3 offset{0};  // m, added to the position
        double factor = 1;     // on the strength, as the kind's `times` says
    };
    std::vector<Keyframe> keyframes;  // at least two; their times rise
    bool repeats = false;
};

struct Force {
    std::string name;
    Boxed<ForceShape> shape;
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

const Description& describe(const ForcePath::Keyframe*);
const Description& describe(const ForcePath*);
const Description& describe(const Force*);

// Where it stands; the others act alike everywhere.
std::optional<glm::dvec3> placeOf(const ForceShape& shape);

// Whether it is for the groups of that name.
bool actsOn(const Force& force, const std::string& group);

const char* kindName(const ForceShape& shape);  // its word in files

}  // namespace shoal
