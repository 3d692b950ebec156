// Evaluates a set of (time, error) points: which are worth having, and what an error costs. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/accuracy.h"

namespace shoal::measure {

// Indices of the points of which no other is both at least as fast and at least as near (of equals the first
// stays), by growing time.
std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& timeAndError);

// Sets AccuracyPoint::front of all that have a time and an error.
void markFront(std::vector<AccuracyPoint>& points);

struct Sample {
    double time = 0, error = 0;
    double steps = 0;  // a second
};

// The cost of an error on one curve.
struct AtError {
    double time = 0;
    double stepsPerSecond = 0;
    bool atLargestStep = false;  // the largest step that could be taken is already good enough
};
// `curve`: by growing steps, all values above 0. Between two points both logarithms are interpolated; of
// several crossings the cheapest counts. Nothing: the curve does not get there.
std::optional<AtError> costAt(const std::vector<Sample>& curve, double error);

// The curve of one method: its points with time and error.
std::vector<Sample> curveOf(const std::vector<AccuracyPoint>& points, const Method& method);
// The methods of a report, in the order of its points.
std::vector<Method> methodsOf(const std::vector<AccuracyPoint>& points);

// The cheapest of a solver over its field samplings.
struct BestOf {
    Method method;
    AtError cost;
};
std::optional<BestOf> bestOf(const std::vector<AccuracyPoint>& points, SolverKind solver, double error);

}  // namespace shoal::measure
