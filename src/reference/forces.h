// The scene's forces in double precision. Formulas and units: scene/force.h. Those of the mouse do not act.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal::reference {

// Returns the forces that act on the group.
std::vector<Force> forcesOn(const Scene& scene, const Group& group);

// Sum of attract and vortexLine at x, m/s^2.
glm::dvec3 forceAcceleration(const std::vector<Force>& forces, const glm::dvec3& x, double time);

// Sum of the winds, m/s: part of the fluid's velocity.
glm::dvec3 forceWind(const std::vector<Force>& forces, double time);

// The acceleration by thrust at a molecule's mean velocity, m/s^2.
glm::dvec3 thrustAcceleration(const std::vector<Force>& forces, const glm::dvec3& velocity, double time);

// By mass; pinned vertices count as at rest.
struct Problem;
glm::dvec3 meanVelocity(const Problem& problem, const std::vector<glm::dvec3>& velocity);

}  // namespace shoal::reference
