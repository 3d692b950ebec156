#include "measure/confidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/contract.h"

namespace shoal::measure {

// [Abramowitz 1964], 26.7.3 and 26.7.4: sums of cosines that end.
double studentShare(double t, int freedom) {
    const double angle = std::atan(t / std::sqrt(double(freedom)));
    const double c = std::cos(angle), s = std::sin(angle);
    const bool odd = freedom % 2 == 1;
    double term = odd ? c : 1, sum = freedom > 1 ? term : 0;
    for (int k = odd ? 3 : 2; k + 2 <= freedom; k += 2) {
        term *= c * c * (k - 1) / k;
        sum += term;
    }
    return odd ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

double studentLimit(double share, int freedom) {
    EXPECTS(share >= 0 && share < 1 && freedom >= 1);
    double low = 0, high = 1;
    while (studentShare(high, freedom) < share && high < 1e12)
        low = std::exchange(high, 2 * high);
    for (int i = 0; i < 100 && high - low > 1e-9 * high; ++i) {
        const double middle = (low + high) / 2;
        (studentShare(middle, freedom) < share ? low : high) = middle;
    }
    return (low + high) / 2;
}

Estimate estimateOf(const std::vector<double>& values, double confidence) {
    const double n = double(values.size());
    Estimate out{0, std::numeric_limits<double>::infinity()};
    for (const double value : values)
        out.mean += value / n;
    if (values.size() < 2) return out;
    double squares = 0;
    for (const double value : values)
        squares += (value - out.mean) * (value - out.mean);
    out.half = studentLimit(confidence, int(values.size()) - 1) * std::sqrt(squares / (n - 1) / n);
    return out;
}

double quantileOf(std::vector<double> values, double share) {
    EXPECTS(!values.empty());
    const double place = share * double(values.size() - 1);
    const auto below = size_t(place);
    const auto nth = values.begin() + ptrdiff_t(below);
    std::nth_element(values.begin(), nth, values.end());
    if (below + 1 == values.size()) return *nth;
    const double next = *std::min_element(nth + 1, values.end());
    return *nth + (place - double(below)) * (next - *nth);
}

}  // namespace shoal::measure
