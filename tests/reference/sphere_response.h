// The response to contact of spheres in double precision: the same equations as shaders/physics/pair.glsl and
// shaders/contact/respond.glsl (docs/contact.md), written for themselves.
#pragma once

#include "reference/sphere_contact.h"

namespace shoal::reference {

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
