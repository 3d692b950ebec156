// How large the scene is, for the shadow map and the crown's shade. From the start state: cheap and constant.
#pragma once

#include <glm/glm.hpp>

#include "compile/plan.h"
#include "scene/scene.h"

namespace shoal {

struct Sphere {
    glm::dvec3 center{0};
    double radius = 0;  // m; 0: none
};

struct SceneBounds {
    // Bounds of the shadow casters: molecules, the models that carry them, and drawn colliders with an end.
    // All drawn models where there is none of these.
    Box casters;
    // Around the molecules that are placed densely on a model and hide the sky from one another.
    Sphere crown;
};

SceneBounds boundsOf(const Scene& scene, const Plan& plan);

}  // namespace shoal
