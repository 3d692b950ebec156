// shaders/physics and step/advance.glsl as C++: the text that the GPU runs, compiled through GLM, so that a
// test can call it.
#pragma once

#include <glm/glm.hpp>

// GLSL converts and shadows as it likes; the project's own C++ does not.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-declarations"

namespace shoal::shader {

using namespace glm;

namespace {

// clang-format off: field.glsl includes noise.glsl itself
#include "physics/anchor.glsl"
#include "physics/cells.glsl"
#include "physics/collide.glsl"
#include "physics/drag.glsl"
#include "physics/field.glsl"
#include "physics/force.glsl"
#include "physics/normal.glsl"
#include "physics/pair.glsl"
#include "physics/random.glsl"
#include "physics/relaxation.glsl"
#define FASTEST_SQUARED 1e8
#include "physics/runaway.glsl"
#undef FASTEST_SQUARED
#include "physics/school.glsl"
#include "physics/solid.glsl"
#include "physics/spring.glsl"
// clang-format on
float substep = 0;
int slips = 0;
#define LEAPFROG
#include "step/advance.glsl"
#undef LEAPFROG

}  // namespace

}  // namespace shoal::shader

#pragma GCC diagnostic pop
