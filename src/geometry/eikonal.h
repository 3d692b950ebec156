// Distances continued over samples that have none of their own.
#pragma once

#include <vector>

#include "geometry/winding_numbers.h"

namespace shoal {

// Solves |grad d| = 1 inwards (d negative) for the samples that are marked, from all others, by fast sweeping
// [Zhao 2005]: of first order in the cell.
void continueInwards(std::vector<float>& distances, const std::vector<char>& marked, const SampleGrid& grid);

}  // namespace shoal
