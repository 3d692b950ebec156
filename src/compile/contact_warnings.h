// Warns of contact that is valid in a scene and probably not meant, or that will not hold.
#pragma once

#include "compile/plan.h"

namespace shoal {

// Adds to the plan's warnings, when all else of it is made: contact of no group, spheres that are too large
// or leave gaps, masses too unlike to lie on one another, soft solids that would shake in stacks, tall piles
// that fall too fast, and crowds.
void warnOfContact(const Scene& scene, Plan& plan);

// Up, to two digits.
double upToTwoDigits(double value);

}  // namespace shoal
