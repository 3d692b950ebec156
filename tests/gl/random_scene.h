// Scenes drawn at random, of one group, for claims about errors.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace shoal::test {

constexpr int randomMolecules = 24;

// Draws a scene of one group. Chances are independent, "log" is uniform in the logarithm:
//   molecule    quad, cross, leaf, fry                  stiffness  log 0.1 to 1,000 of its own: 6 to 2,500 Hz
//   pins        half of the leaves, by their stems      turn       any; scale 0.7 to 1.4
//   drag        3 of 4: log 0.1 to 10 /s, half of these by direction: along the surface a tenth
//   wind        none, shear, vortex, gust, curlNoise    speed      log 0.3 to 3 m/s
//   spin        one of 3 of what is not pinned: up to 8 rad/s about each axis
//   plane       one of 4, 0.5 m below the lowest: restitution 0.5, friction 0.3
Scene randomScene(uint64_t seed);

}  // namespace shoal::test
