// Times that are taken in turn, and their statistics.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace shoal::measure {

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point start);
double steadySeconds();  // of the clock
template <typename Work>
double secondsOf(const Work& work) {
    const Clock::time_point start = Clock::now();
    work();
    return secondsSince(start);
}

// The time that a whole measurement may take. Its stages end at growing shares of it, so that what an early
// one does not need is left to the later ones.
class TimeLimit {
  public:
    // Nothing: there is no limit. `clock`: s.
    explicit TimeLimit(std::optional<double> seconds, std::function<double()> clock = steadySeconds);

    // s until so much of it is over, at least 0; infinity without a limit.
    double left(double share = 1) const;
    bool over(double share = 1) const { return left(share) <= 0; }
    // Likewise, with less time from the same start.
    TimeLimit part(double share) const;
    const std::optional<double>& seconds() const { return seconds_; }
    // Does not count so many seconds that have passed.
    void leaveOut(double seconds) { start_ += seconds; }

  private:
    std::optional<double> seconds_;
    std::function<double()> clock_;
    double start_;
};

struct Spread {
    double min = 0, median = 0;  // of the values; 0 without any
    int samples = 0;
};
Spread spreadOf(std::vector<double> values);

// Whether a challenger's time stays above the best one's when both are timed again, in turn, up to three
// times: each keeps its least. Ends early where three times as much was found twice.
bool losesAgain(double& challenger, double& best, const std::function<double()>& timeChallenger,
                const std::function<double()>& timeBest);

// Measurements in turn: what is compared is visited round after round, so that a machine whose speed drifts
// drifts for all alike. What is slow sits out rounds, evenly.
struct Schedule {
    double seconds = 15;  // of frames and restarts, a group
    int leastSamples = 3, mostSamples = 100;
    // s, that the least samples of a case may take together. A slower case gets fewer samples, and none
    // beyond the warm-up where a single visit takes longer.
    double patience = std::numeric_limits<double>::infinity();
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
// Calls visit(i) for each case in each round that it takes part in.
template <typename Visit>
void takeTurns(const VisitPlan& plan, Visit visit) {
    for (int round = 0; round < plan.rounds; ++round)
        for (size_t i = 0; i < plan.samples.size(); ++i)
            if (plan.visits(i, round)) visit(i);
}

// Ties the process's llvmpipe workers to one core each, in turn: left alone, the worker threads of a CPU
// rasteriser share one core half of the time, which doubles the noise. Returns how many there were.
int pinRasteriserThreads();

}  // namespace shoal::measure
