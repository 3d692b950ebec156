// A k-d tree over points [Bentley 1975]: the nearest one, and all within a radius, in the order of log n.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace shoal::measure {

class PointTree {
  public:
    explicit PointTree(std::vector<glm::dvec3> points);

    // m, from a point of the tree to the nearest other one; infinite where there is none.
    double nearestDistance(size_t point) const;

    // Calls visit(point) for each whose distance from the place is at most `radius`.
    template <typename Visit>
    void within(const glm::dvec3& place, double radius, Visit&& visit) const {
        visitWithin(0, order_.size(), place, radius, visit);
    }

  private:
    // Points first .. last - 1 of the order are a subtree: its middle one splits the others along the axis.
    static size_t middleOf(size_t first, size_t last) { return first + (last - first) / 2; }
    void build(size_t first, size_t last);
    void search(size_t first, size_t last, size_t point, double& squared) const;

    template <typename Visit>
    void visitWithin(size_t first, size_t last, const glm::dvec3& place, double radius, Visit& visit) const {
        if (first == last) return;
        const size_t middle = middleOf(first, last);
        const glm::dvec3 away = place - points_[order_[middle]];
        if (glm::dot(away, away) <= radius * radius) visit(size_t(order_[middle]));
        const double across = away[axes_[middle]];
        if (across <= radius) visitWithin(first, middle, place, radius, visit);
        if (across >= -radius) visitWithin(middle + 1, last, place, radius, visit);
    }

    std::vector<glm::dvec3> points_;
    std::vector<uint32_t> order_;
    std::vector<uint8_t> axes_;  // along which the subtree of that middle is split
};

}  // namespace shoal::measure
