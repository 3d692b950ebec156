// The warnings of `shoal check` about how a scene starts: it is valid, but probably not what was meant.
#pragma once

#include <vector>

#include "compile/plan.h"
#include "scene/scene.h"

namespace shoal::app {

// Warns where 5 % of a group or more start wholly inside a collider or below the ground, and of a camera that
// sees neither a molecule nor a model nor an emitter. Of large groups and models only some thousand vertices
// are looked at.
std::vector<Warning> checkStart(const Scene& scene, const Plan& plan);

}  // namespace shoal::app
