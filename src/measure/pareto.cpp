#include "measure/accuracy.h"

#include <algorithm>
#include <numeric>

namespace shoal::measure {

std::vector<Step> stepLadder(int mostSplits) {
    std::vector<Step> out;
    for (int steps = 1; steps <= maxSubsteps * mostSplits; steps *= 2) {
        Step step;
        while (steps / step.split > maxSubsteps)
            step.split *= 2;
        step.substeps = steps / step.split;
        out.push_back(step);
    }
    return out;
}

std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& timeAndError) {
    std::vector<size_t> order(timeAndError.size()), out;
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return timeAndError[a] < timeAndError[b]; });
    for (const size_t i : order)
        if (out.empty() || timeAndError[i].second < timeAndError[out.back()].second) out.push_back(i);
    return out;
}

void markFront(std::vector<AccuracyPoint>& points) {
    std::vector<std::pair<double, double>> pairs;
    std::vector<size_t> places;
    for (size_t i = 0; i < points.size(); ++i) {
        points[i].front = false;
        if (!points[i].error || points[i].time.samples == 0) continue;
        pairs.emplace_back(points[i].time.min, points[i].error->total);
        places.push_back(i);
    }
    for (const size_t i : paretoFront(pairs))
        points[places[i]].front = true;
}

}  // namespace shoal::measure
