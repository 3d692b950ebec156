// What is said about a handful of times.
#pragma once

#include <vector>

namespace shoal::measure {

struct Spread {
    double min = 0, median = 0;  // of the values; 0 without any
    int samples = 0;
};
Spread spreadOf(std::vector<double> values);

}  // namespace shoal::measure
