#include "geometry/sample_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal {

namespace {

// The depth at a sample from the least depths beside it along each axis (Godunov's upwind difference).
double depthFrom(double a, double b, double c, double cell) {
    if (a > b) std::swap(a, b);
    if (b > c) std::swap(b, c);
    if (a > b) std::swap(a, b);
    double out = a + cell;
    if (out <= b) return out;
    out = (a + b + std::sqrt(std::max(2 * cell * cell - (a - b) * (a - b), 0.0))) / 2;
    if (out <= c) return out;
    const double sum = a + b + c, squares = a * a + b * b + c * c;
    return (sum + std::sqrt(std::max(sum * sum - 3 * (squares - cell * cell), 0.0))) / 3;
}

}  // namespace

void continueInwards(std::vector<float>& distances, const std::vector<char>& marked, const SampleGrid& grid) {
    constexpr float unknown = -std::numeric_limits<float>::max();
    for (size_t i = 0; i < distances.size(); ++i)
        if (marked[i]) distances[i] = unknown;
    const auto depth = [&](int x, int y, int z) {
        const bool within =
            x >= 0 && y >= 0 && z >= 0 && x < grid.size.x && y < grid.size.y && z < grid.size.z;
        return within ? -double(distances[grid.index(x, y, z)]) : std::numeric_limits<double>::max();
    };
    const auto update = [&](int x, int y, int z) {
        float& d = distances[grid.index(x, y, z)];
        const double found = depthFrom(std::min(depth(x - 1, y, z), depth(x + 1, y, z)),
                                       std::min(depth(x, y - 1, z), depth(x, y + 1, z)),
                                       std::min(depth(x, y, z - 1), depth(x, y, z + 1)), grid.cell);
        d = std::max(d, -float(std::min(found, 1e30)));
    };
    for (int sweep = 0; sweep < 16; ++sweep) {  // eight directions, twice
        for (int k = 0; k < grid.size.z; ++k)
            for (int j = 0; j < grid.size.y; ++j)
                for (int i = 0; i < grid.size.x; ++i) {
                    const int x = sweep & 1 ? grid.size.x - 1 - i : i,
                              y = sweep & 2 ? grid.size.y - 1 - j : j;
                    const int z = sweep & 4 ? grid.size.z - 1 - k : k;
                    if (marked[grid.index(x, y, z)]) update(x, y, z);
                }
    }
}

}  // namespace shoal
