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

#include "measure/bench_case.h"
#include "measure/bench_runner.h"
#include "measure/statistics.h"

namespace shoal::measure {

struct BenchResult {
    BenchCase one;
    std::string leftOut;  // why it was not measured; empty: it was
    Spread frame;         // s
    int framesPerSample = 1;
    size_t stateBytes = 0, movedBytes = 0;  // BenchRunner's
    double operations = 0;                  // BenchRunner's
    double busStateBytes = 0;               // a frame: state that crossed the bus
    Lanes lanes = Lanes::automatic;
    double perMolecule() const { return frame.min / one.count; }  // s, by the shortest
};

struct BenchSchedule {
    double seconds = 15;  // of frames and restarts, a group
    int leastSamples = 3, mostSamples = 100;
};

// How a group is spread over rounds.
struct VisitPlan {
    std::vector<int> samples;  // of each case
    int rounds = 0;            // the most of them
    double seconds = 0;        // all together
    // Whether a case takes part in a round: evenly, samples[i] times in all.
    bool visits(size_t i, int round) const;
};
// `cost`: seconds of one visit, for each case.
VisitPlan planVisits(const std::vector<double>& cost, const BenchSchedule& schedule);
// Calls visit(i) for each case in each round that it takes part in, and begin(round) before each round.
template <typename Begin, typename Visit>
void takeTurns(const VisitPlan& plan, Begin begin, Visit visit) {
    for (int round = 0; round < plan.rounds; ++round) {
        begin(round);
        for (size_t i = 0; i < plan.samples.size(); ++i)
            if (plan.visits(i, round)) visit(i);
    }
}
template <typename Visit>
void takeTurns(const VisitPlan& plan, Visit visit) {
    takeTurns(
        plan, [](int) {}, visit);
}

// What is being done, and the estimated seconds that this group still takes.
using BenchProgress = std::function<void(const std::string& what, double secondsLeft)>;

// Cases of one group: same molecule and count. Error: the driver refuses a shader.
std::vector<BenchResult> measureGroup(const std::vector<BenchCase>& cases, const BenchMolecules& molecules,
                                      const BenchDevice& device, const BenchSchedule& schedule,
                                      const BenchProgress& progress);

// The cases of a list by their groups, in the order of the list.
std::vector<std::vector<BenchCase>> byGroup(const std::vector<BenchCase>& cases);

}  // namespace shoal::measure
