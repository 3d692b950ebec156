// Measurements in turn: what is compared is visited round after round, so that a machine whose speed drifts
// drifts for all alike. What is slow sits out rounds, evenly.
#pragma once

#include <cstddef>
#include <vector>

namespace shoal::measure {

struct Schedule {
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
VisitPlan planVisits(const std::vector<double>& cost, const Schedule& schedule);
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

}  // namespace shoal::measure
