// The response to contact of spheres in double precision: the equations of docs/contact.md, written for
// themselves; without colliders, triangles and rigid bodies.
#pragma once

#include <map>

#include "reference/sphere_contact.h"

namespace shoal::reference {

struct SphereResponse {
    double stepTime = 0;   // s, since the last contact step
    double restSpeed = 0;  // m/s: slower is rest
    double restitution = 0.2, friction = 0.5;
    int iterations = 8;
};

// The memory that contacts leave for the next step.
struct ContactMemory {
    struct Entry {
        glm::dvec3 impulse{0};  // N s, on the first sphere
        glm::dvec3 anchor{0};   // m, from the second's centre to the first's when they began to stick
        bool sticks = false;
        double apart = 0;  // kg m, by which the two were pushed apart
        int bounces = 0;   // steps with an impact, up to the last
    };
    std::map<std::pair<int, int>, Entry> contacts;  // by spheres
    // N s, by sphere: the sums of the impulses, which are to act as a force until the next step.
    std::vector<glm::dvec3> loads;
};

// Moves the spheres apart and changes their velocities, all contacts at once. `contacts`: as touching()
// tells. `memory` begins empty.
void respond(std::vector<Sphere>& spheres, const std::vector<std::pair<int, int>>& contacts,
             const SphereResponse& settings, ContactMemory& memory);

}  // namespace shoal::reference
