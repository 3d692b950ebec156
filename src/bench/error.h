// The error that a speed buys: quads spinning in the air, after 1 s at the benchmark's step, against the
// double-precision reference.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "bench/runner.h"

namespace shoal::bench {

struct BenchError {
    Subject subject = Subject::fused;
    SolverKind solver = SolverKind::euler;
    Wind wind = Wind::uniform;
    FieldSampling sampling = FieldSampling::vertexSubstep;
    // RMS distance of the vertices over the molecule's size, RMS over the molecules. Nothing: the reference
    // does not converge, or the context lacks the path.
    std::optional<double> relative;
};

// Calls `progress` some times with the share that is done. `count`: molecules.
std::vector<BenchError> measureErrors(const BenchMolecules& molecules, const BenchDevice& device, int count,
                                      const std::function<void(double share)>& progress);

}  // namespace shoal::bench
