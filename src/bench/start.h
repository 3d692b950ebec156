// How long it takes from nothing to the first frame.
#pragma once

#include <string>
#include <vector>

#include "bench/runner.h"

namespace shoal::bench {

// Seconds. The last three are of making a Simulation and its first frame, waited for:
struct StartTime {
    std::string molecule;
    SolverKind solver = SolverKind::euler;
    int count = 0;
    double compile = 0;  // scene to plan
    double cold = 0;     // a kernel that neither our cache nor the driver's has seen
    double driver = 0;   // the driver's own cache may know it
    double cached = 0;   // our cache has it, too
};

// Makes a folder for a cache of its own and removes it. Empty below OpenGL 4.3.
std::vector<StartTime> measureStart(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                    const std::function<void(double share)>& progress);

}  // namespace shoal::bench
