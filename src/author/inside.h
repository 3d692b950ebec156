// The volume of a closed mesh as samples of a grid: is a point inside, how much is near what.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/sample_grid.h"

namespace shoal {

class Inside {
  public:
    // Samples a closed mesh. Parts thinner than a cell, a 250th of the longest side at the finest, may be
    // missed.
    explicit Inside(const Mesh& mesh);

    bool at(const glm::dvec3& point) const;
    // The share of points of the segment that lie inside.
    double share(const glm::dvec3& a, const glm::dvec3& b) const;
    double volume() const { return double(samples_.size()) * grid_.cell * grid_.cell * grid_.cell; }
    const std::vector<glm::dvec3>& samples() const { return samples_; }  // the middle of every cell inside

  private:
    SampleGrid grid_;
    std::vector<int16_t> winding_;
    std::vector<glm::dvec3> samples_;
};

}  // namespace shoal
