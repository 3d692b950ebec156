// Statistics of a handful of times.
#pragma once

#include <functional>
#include <vector>

namespace shoal::measure {

struct Spread {
    double min = 0, median = 0;  // of the values; 0 without any
    int samples = 0;
};
Spread spreadOf(std::vector<double> values);

// Whether a challenger's time stays above the best one's when both are timed again, in turn, up to three
// times: each keeps its least. Ends early where three times as much was found twice.
bool losesAgain(double& challenger, double& best, const std::function<double()>& timeChallenger,
                const std::function<double()>& timeBest);

}  // namespace shoal::measure
