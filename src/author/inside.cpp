#include "author/inside.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace shoal {

Inside::Inside(const Mesh& mesh) {
    constexpr double wanted = 200'000;  // samples
    constexpr double finest = 1.0 / 250;
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    const glm::dvec3 box = glm::max(extent, glm::dvec3(finest * longest));
    grid_.cell = std::max(std::cbrt(box.x * box.y * box.z / wanted), finest * longest);
    grid_.size = glm::ivec3(glm::ceil(box / grid_.cell)) + 1;
    grid_.low = 0.5 * (mesh.low + mesh.high) - 0.5 * grid_.cell * glm::dvec3(grid_.size - 1);
    winding_ = windingNumbers(mesh, grid_, allThreads());
    for (int z = 0; z < grid_.size.z; ++z)
        for (int y = 0; y < grid_.size.y; ++y)
            for (int x = 0; x < grid_.size.x; ++x)
                if (winding_[grid_.index(x, y, z)] != 0) samples_.push_back(grid_.place(x, y, z));
}

bool Inside::at(const glm::dvec3& point) const {
    const glm::ivec3 cell(glm::round((point - grid_.low) / grid_.cell));
    for (int axis = 0; axis < 3; ++axis)
        if (cell[axis] < 0 || cell[axis] >= grid_.size[axis]) return false;
    return winding_[grid_.index(cell.x, cell.y, cell.z)] != 0;
}

double Inside::share(const glm::dvec3& a, const glm::dvec3& b) const {
    constexpr int points = 9;
    int count = 0;
    for (int i = 1; i <= points; ++i)
        count += at(glm::mix(a, b, double(i) / (points + 1))) ? 1 : 0;
    return double(count) / points;
}

}  // namespace shoal
