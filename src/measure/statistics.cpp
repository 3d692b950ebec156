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

}  // namespace shoal::measure
