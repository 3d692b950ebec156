// Finds muscles that cannot do what is asked: to move faster than the spring, or the step, can follow, or to
// shrink to nothing.
#pragma once

#include <vector>

#include "scene/scene.h"

namespace shoal {

// Adds a warning, located at the spring, for the first muscle of each kind of trouble: shorter than a quarter
// of its length; a beat of fewer than 8 substeps; faster than the spring's own frequency.
// Error, located at the spring: its beat and the school's bend together leave nothing of it.
void checkMuscles(const Scene& scene, const Group& group, std::vector<Warning>& warnings);

}  // namespace shoal
