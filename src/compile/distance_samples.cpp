#include "compile/distance_samples.h"

#include <algorithm>

namespace shoal {

size_t appendDistances(const DistanceField& field, std::vector<glm::vec4>& table) {
    const SampleGrid& grid = field.grid;
    const size_t base = table.size();
    table.reserve(base + grid.count());
    for (int y = 0; y < grid.size.y; ++y)
        for (int x = 0; x < grid.size.x; ++x)
            for (int z = 0; z < grid.size.z; ++z) {
                const int right = std::min(x + 1, grid.size.x - 1), up = std::min(y + 1, grid.size.y - 1);
                table.emplace_back(
                    field.distances[grid.index(x, y, z)], field.distances[grid.index(right, y, z)],
                    field.distances[grid.index(x, up, z)], field.distances[grid.index(right, up, z)]);
            }
    return base;
}

}  // namespace shoal
