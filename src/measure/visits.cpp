#include "measure/visits.h"

#include <algorithm>
#include <cstdint>

namespace shoal::measure {

bool VisitPlan::visits(size_t i, int round) const {
    const int64_t n = samples[i];
    return (round + 1) * n / rounds > round * n / rounds;
}

VisitPlan planVisits(const std::vector<double>& cost, const Schedule& schedule) {
    VisitPlan out;
    const double share = schedule.seconds / double(std::max<size_t>(1, cost.size()));
    for (const double one : cost) {
        const double fit = std::min(double(schedule.mostSamples), share / std::max(one, 1e-9));
        out.samples.push_back(std::max(schedule.leastSamples, int(fit)));
        out.rounds = std::max(out.rounds, out.samples.back());
        out.seconds += one * out.samples.back();
    }
    return out;
}

}  // namespace shoal::measure
