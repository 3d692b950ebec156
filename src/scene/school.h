// How the molecules of a group steer by one another: separation, alignment and cohesion [Reynolds 1987],
// flight from other groups and hunting them, walls, a depth and a home that they like. Each swims along the
// +Z of its rest shape, with +Y up. Method and what each number does: docs/school.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"
#include "scene/placement.h"

namespace shoal {

class Description;
struct Group;

// Others that are fled from, or hunted.
struct SchoolTarget {
    std::string group;
    double radius = 2;    // m, within which they are noticed
    double strength = 4;  // m/s^2: at the distance 0, down to none at the radius
    Location location;
};

// Where they like to be: pulled back by `strength` times the way out of it.
struct SchoolHome {
    std::optional<Box> box;
    glm::dvec3 center{0};  // of a ball, where there is no box
    double radius = 0;     // m
    double strength = 1;   // 1/s^2
};

// Accelerations add up; those away from walls and enemies, and back home, go before the others, and all
// together are at most `acceleration`. What points along the body is thrust; what points aside turns it.
struct School {
    double radius = 0.5;            // m: others nearer than this count
    double blind = 0.5;             // rad: half the angle of the cone behind in which none is seen
    double separationRadius = 0.2;  // m: those nearer than this are kept away from
    double separation = 4;          // m/s^2 each, at the distance 0, down to none at separationRadius
    double alignment = 2;           // 1/s: how fast the velocity becomes that of the others
    double cohesion = 2;            // 1/s^2, towards the others' middle
    double slowest = 0.1, cruise = 0.4, fastest = 1;  // m/s
    double acceleration = 3;                          // m/s^2, the most
    double turn = 4;                                  // rad/s, the most
    double steepest = 0.6;                            // rad: the most that it swims up or down
    double reaction = 0.15;                           // s: within which steering follows what is seen
    double bend = 1;      // rad: the most that its ends turn to one another, by its muscles
    double beat = 0.4;    // m/s: the speed at which its muscles run at their own frequency; 0: at any
    double fins = 1;      // share of the thrust that its tail does not give, added by un-damping
    double wander = 0.4;  // m/s^2, to here and there at random
    std::optional<glm::dvec2> depth;  // m: lowest and highest y that is liked
    double depthStrength = 1;         // 1/s^2, back towards it
    double walls = 0.5;               // m from colliders, within which they are turned from; 0: not
    double look = 0.5;                // s: how far ahead walls are seen
    std::optional<SchoolHome> home;
    std::vector<SchoolTarget> flees, hunts;
    Location location;
};

constexpr size_t mostSchoolTargets = 8;  // of a group

const Description& describe(const SchoolTarget*);
const Description& describe(const SchoolHome*);
const Description& describe(const School*);

// Checks the schools of all groups. Error, located at the target: a group that there is not, its own, one
// both fled and hunted; located at the school: more than mostSchoolTargets.
void checkSchools(const std::vector<Group>& groups);

}  // namespace shoal
