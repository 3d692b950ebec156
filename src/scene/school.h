// How the molecules of a group steer by one another: separation, alignment and cohesion (Reynolds 1987),
// flight from other groups and hunting them, walls, a preferred depth. What swims does so with its own
// springs; steering bends it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

// Others that are fled from, or followed.
struct SchoolTarget {
    std::string group;
    double radius = 2;    // m, within which they are noticed
    double strength = 4;  // m/s^2, at the distance 0, down to none at the radius
    Location location;
};

// Steering accelerations add up, are cut off at `acceleration`, and turn the velocity by at most `turn`.
struct School {
    double radius = 1;              // m: others nearer than this count
    double separationRadius = 0.4;  // m: those nearer than this are kept away from
    double separation = 2;          // m/s^2, at the distance 0, down to none at separationRadius
    double alignment = 1;           // 1/s: how fast the velocity becomes that of the others
    double cohesion = 0.5;          // 1/s^2, towards the others' middle
    double slowest = 0.2, cruise = 0.6, fastest = 2;  // m/s
    double acceleration = 4;                          // m/s^2, the most
    double turn = 4;                                  // rad/s, the most
    std::optional<glm::dvec2> depth;                  // m: lowest and highest y that is liked
    double depthStrength = 1;                         // 1/s^2, back towards it
    double walls = 0.5;  // m from colliders, within which they are turned from; 0: not
    std::vector<SchoolTarget> flees, hunts;
    Location location;
};

}  // namespace shoal
