// Distance fields as the device reads them.
#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/distance_field.h"

namespace shoal {

// Appends the field to the table and returns where it begins. Of sample (i, j, k) the 4-vector at
// (j * size.x + i) * size.z + k holds the distances of (i, j), (i + 1, j), (i, j + 1) and (i + 1, j + 1) in
// layer k, so that a cell is two 4-vectors that follow one another.
size_t appendDistances(const DistanceField& field, std::vector<glm::vec4>& table);

}  // namespace shoal
