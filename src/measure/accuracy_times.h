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
};

// Seconds that one visit of a contender takes: back to the start, a frame that is not timed where frames are
// short, then a few that are, between two waits.
double secondsOfVisit(const Contender& one);

// What the least number of samples of all will take.
double leastSeconds(const std::vector<Contender>& contenders);

// Seconds a frame. With `seconds`, what does not fit goes without samples, the dearest first.
// `tell`: seconds that are done.
std::vector<Spread> timeInTurn(const std::vector<Contender>& contenders, std::optional<double> seconds,
                               const std::function<void(double)>& tell);

}  // namespace shoal::measure
