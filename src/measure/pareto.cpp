#include "measure/accuracy.h"

#include <algorithm>
#include <cmath>
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

std::optional<AtError> costAt(const std::vector<Sample>& curve, double error) {
    std::optional<AtError> best;
    const auto offer = [&](const AtError& offered) {
        if (!best || offered.time < best->time) best = offered;
    };
    if (!curve.empty() && curve.front().error <= error)
        offer({curve.front().time, curve.front().steps, true});
    for (size_t i = 0; i + 1 < curve.size(); ++i) {
        const Sample &a = curve[i], &b = curve[i + 1];
        if (!(a.error > error && b.error <= error)) continue;
        const double share = std::log(a.error / error) / std::log(a.error / b.error);
        offer(
            {a.time * std::pow(b.time / a.time, share), a.steps * std::pow(b.steps / a.steps, share), false});
    }
    return best;
}

std::vector<Sample> curveOf(const std::vector<AccuracyPoint>& points, const Method& method) {
    std::vector<Sample> out;
    for (const AccuracyPoint& point : points)
        if (point.method == method && point.error && point.time.samples > 0)
            out.push_back({point.time.min, std::max(point.error->total, 1e-12), point.stepsPerSecond});
    std::stable_sort(out.begin(), out.end(),
                     [](const Sample& a, const Sample& b) { return a.steps < b.steps; });
    return out;
}

std::vector<Method> methodsOf(const std::vector<AccuracyPoint>& points) {
    std::vector<Method> out;
    for (const AccuracyPoint& point : points)
        if (std::find(out.begin(), out.end(), point.method) == out.end()) out.push_back(point.method);
    return out;
}

std::optional<BestOf> bestOf(const std::vector<AccuracyPoint>& points, SolverKind solver, double error) {
    std::optional<BestOf> best;
    for (const Method& method : methodsOf(points)) {
        if (method.solver != solver) continue;
        const std::optional<AtError> cost = costAt(curveOf(points, method), error);
        if (cost && (!best || cost->time < best->cost.time)) best = BestOf{method, *cost};
    }
    return best;
}

}  // namespace shoal::measure
