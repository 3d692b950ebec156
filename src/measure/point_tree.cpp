#include "measure/point_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace shoal::measure {

PointTree::PointTree(std::vector<glm::dvec3> points)
    : points_(std::move(points)), order_(points_.size()), axes_(points_.size()) {
    std::iota(order_.begin(), order_.end(), uint32_t(0));
    build(0, order_.size());
}

void PointTree::build(size_t first, size_t last) {
    if (first == last) return;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (size_t i = first; i < last; ++i) {
        low = glm::min(low, points_[order_[i]]);
        high = glm::max(high, points_[order_[i]]);
    }
    const glm::dvec3 extent = high - low;
    const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
    const size_t middle = middleOf(first, last);
    const auto begin = order_.begin();
    std::nth_element(begin + ptrdiff_t(first), begin + ptrdiff_t(middle), begin + ptrdiff_t(last),
                     [&](uint32_t a, uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    axes_[middle] = uint8_t(axis);
    build(first, middle);
    build(middle + 1, last);
}

void PointTree::search(size_t first, size_t last, size_t point, double& squared) const {
    if (first == last) return;
    const size_t middle = middleOf(first, last);
    const glm::dvec3 away = points_[point] - points_[order_[middle]];
    if (order_[middle] != point) squared = std::min(squared, glm::dot(away, away));
    const double across = away[axes_[middle]];
    const bool below = across < 0;
    search(below ? first : middle + 1, below ? middle : last, point, squared);
    if (across * across <= squared) search(below ? middle + 1 : first, below ? last : middle, point, squared);
}

double PointTree::nearestDistance(size_t point) const {
    double squared = std::numeric_limits<double>::infinity();
    search(0, order_.size(), point, squared);
    return std::sqrt(squared);
}

}  // namespace shoal::measure
