// Warns of what is valid in a scene and probably not meant, as far as a plan shows it.
#pragma once

#include "compile/plan.h"

namespace shoal {

// Adds to the plan's warnings, when all else of it is made: those of contact (compile/contact_warnings.h),
// fields that nothing feels, schools that cannot swim, and what is drawn larger than it touches.
void warnOf(const Scene& scene, Plan& plan);

}  // namespace shoal
