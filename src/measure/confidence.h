// Means, quantiles and their confidence intervals by Student's t [Student 1908].
#pragma once

#include <vector>

namespace shoal::measure {

// The share of Student's t distribution between -t and t, of so many degrees of freedom, at least 1; exact
// but for rounding.
double studentShare(double t, int freedom);
// The t within which that share lies, 0 <= share < 1, to 1e-9 of itself.
double studentLimit(double share, int freedom);

// A mean and half the width of its interval, which covers the true mean with the confidence asked for where
// the values are independent and their mean is about normal.
struct Estimate {
    double mean = 0;
    double half = 0;  // infinite of a single value
    bool excludesZero() const { return mean > half || -mean > half; }
};
constexpr double usualConfidence = 0.95;
Estimate estimateOf(const std::vector<double>& values, double confidence = usualConfidence);

// The value below which that share of the values lies, 0 to 1, between neighbours linearly [Hyndman 1996,
// definition 7]. There is at least one value.
double quantileOf(std::vector<double> values, double share);

}  // namespace shoal::measure
