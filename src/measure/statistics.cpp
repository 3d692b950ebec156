#include "measure/statistics.h"

#include <algorithm>

namespace shoal::measure {

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const size_t n = values.size(), middle = n / 2;
    const double median = n % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
    return {values.front(), median, int(n)};
}

bool losesAgain(double& challenger, double& best, const std::function<double()>& timeChallenger,
                const std::function<double()>& timeBest) {
    for (int round = 0; round < 3 && challenger >= best; ++round) {
        best = std::min(best, timeBest());
        const double again = timeChallenger();
        challenger = std::min(challenger, again);
        if (again > 3 * best && challenger > 3 * best) break;
    }
    return challenger >= best;
}

}  // namespace shoal::measure
