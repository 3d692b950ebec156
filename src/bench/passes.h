// Time per pass, from the passes' own timers: queries on a GPU, waits and a clock on a CPU rasteriser.
#pragma once

#include <vector>

#include "bench/runner.h"
#include "gpu/pass_timers.h"
#include "measure/statistics.h"

namespace shoal::bench {

struct PassTable {
    int count = 0;  // quads
    Subject subject = Subject::fused;
    SolverKind solver = SolverKind::euler;
    std::vector<gpu::PassTime> passes;
    measure::Spread frame;  // s, wall-clock, with the timers in it
};

// Quads that are drawn, so that normals are computed, without a picture; round after round for `seconds`.
std::vector<PassTable> measurePasses(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                     double seconds, const std::function<void(double share)>& progress);

}  // namespace shoal::bench
