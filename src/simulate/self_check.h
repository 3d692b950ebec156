// Whether an execution path computes on a driver what it should. Drivers err in silence (docs/testing.md), so
// each path is run once with a small scene, in about a second, and compared with stored numbers. The verdict
// is kept for each driver.
#pragma once

#include <string>

#include "compile/path.h"
#include "gpu/context.h"

namespace shoal {

// The part of the step that a check runs: molecules with springs, drag and a collider, or their contact as
// well.
enum class CheckedPart { step, contact };

// Runs the check's scene on a path for checkedFrames. Returns how far the molecule that is furthest off lies
// from where it should, m; infinite where it is not finite. Error: the driver refuses a shader.
double selfCheckError(gpu::Context& context, Path path, CheckedPart part);

// A correct path is off by less, m: a few roundings of the molecules' 0.1 m, which contact passes on.
constexpr double selfCheckTolerance = 2e-5;

// Returns why a path is not to be relied on with this driver: "contact on the path fragments is off by 8.3 mm
// with ..."; empty: it computes what it should. The verdict is this
// process's, else the one in the context's cache; else the check runs now.
std::string selfCheck(gpu::Context& context, Path path, CheckedPart part);

}  // namespace shoal
