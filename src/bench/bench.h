// The measurement: all cases of a group in turn, round after round, so that a machine whose speed drifts
// drifts for all alike.
//
// A visit of a case: back to the start; a frame that is not timed, so that caches are as in a run of its own;
// then four frames between two waits, one sample. Frames above 0.1 s go without the first and are sampled one
// by one. So all samples of a case are the same frames of the fall, and those of different cases lie within
// the same five. Slow cases sit out rounds, evenly.
//
// Samples of a case differ only by what disturbs them: the shortest says what the work costs, and what is
// derived (ratios, bandwidth) goes by it; the median says what to expect. A case with few samples has had
// fewer chances of a short one: their number is in the report.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/case.h"
#include "bench/runner.h"
#include "measure/statistics.h"
#include "measure/visits.h"

namespace shoal::bench {

struct BenchResult {
    BenchCase one;
    std::string leftOut;    // why it was not measured; empty: it was
    measure::Spread frame;  // s
    int framesPerSample = 1;
    size_t stateBytes = 0, movedBytes = 0;  // BenchRunner's
    double operations = 0;                  // BenchRunner's
    double busStateBytes = 0;               // a frame: state that crossed the bus
    Lanes lanes = Lanes::automatic;
    double perMolecule() const { return frame.min / one.count; }  // s, by the shortest
};

// Reports what is being done, and the estimated seconds that this group still takes.
using BenchProgress = std::function<void(const std::string& what, double secondsLeft)>;

// Cases of one group: same molecule and count. Error: the driver refuses a shader.
std::vector<BenchResult> measureGroup(const std::vector<BenchCase>& cases, const BenchMolecules& molecules,
                                      const BenchDevice& device, const measure::Schedule& schedule,
                                      const BenchProgress& progress);

// The cases of a list by their groups, in the order of the list.
std::vector<std::vector<BenchCase>> byGroup(const std::vector<BenchCase>& cases);

}  // namespace shoal::bench
