// Times of many methods and steps, in turn, round after round, so that a machine whose speed drifts drifts
// for all alike (as bench.h has it).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "measure/method_runner.h"
#include "measure/statistics.h"

namespace shoal::measure {

struct Contender {
    MethodRunner* runner = nullptr;
    Step step;
    double secondsOfFrame = 0;  // about
    double secondsOfStep = 0;   // that setting the step takes: some methods build their program again
};

// Seconds that one visit of a contender takes: its step is set, and one frame from the start is run and
// waited for, untimed, because it may build programs; back to the start, and a wait; then its first 2 to 32
// frames are timed, between two waits, or the first one alone where frames are long.
double secondsOfVisit(const Contender& one);

// Estimates the seconds of all samples: the least number of each, and more while they fit into half a minute.
double leastSeconds(const std::vector<Contender>& contenders);

// Flags the contenders that fit when each takes its seconds, cheapest first. Nothing bounds them: all.
std::vector<bool> thoseThatFit(const std::vector<double>& cost, std::optional<double> seconds);

// Visits in turn, round after round; `visit(i)` is left out where it would end after `seconds`, by `now` (s)
// and by the dearest of its own visits before.
void visitInTurn(const std::vector<double>& cost, std::optional<double> seconds,
                 const std::function<double()>& now, const std::function<void(size_t)>& visit);

// Seconds a frame. With `seconds`, what does not fit goes without samples, the dearest first.
// `tell`: seconds that are done.
std::vector<Spread> timeInTurn(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               const std::function<void(double)>& tell);

}  // namespace shoal::measure
