// How far the method that runs is from the double-precision reference.
#pragma once

#include <string>

#include "measure/method_runner.h"
#include "simulate/simulation.h"

namespace shoal::window {

// Measures the error of a few molecules of each group of `scene`, from its start over half a second, by the
// solver and substeps of the simulation: "error 1.2e-4 of its size (RMS of 4 after 0.5 s)", or why there is
// none. Takes seconds.
std::string methodError(const Scene& scene, const Simulation& simulation,
                        const measure::AccuracyDevice& device);

}  // namespace shoal::window
