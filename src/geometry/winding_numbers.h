// How often a closed mesh winds around each point of a grid: 0 outside, 1 inside, 2 where two shells overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh.h"

namespace shoal {

// Samples at low + cell (i, j, k); x fastest, then y, then z.
struct SampleGrid {
    glm::ivec3 size{0};
    glm::dvec3 low{0};  // m
    double cell = 1;    // m

    size_t count() const { return size_t(size.x) * size_t(size.y) * size_t(size.z); }
    size_t index(int x, int y, int z) const {
        return (size_t(z) * size_t(size.y) + size_t(y)) * size_t(size.x) + size_t(x);
    }
    glm::dvec3 place(int x, int y, int z) const { return low + cell * glm::dvec3(x, y, z); }
    glm::dvec3 high() const { return low + cell * glm::dvec3(size - 1); }
};

// Along all lines of the grid in x, in y and in z the triangles' crossings are counted, each by its side; a
// sample takes the middle one of its three counts, so that a line that rounding misled is outvoted. Ties,
// where a line meets an edge or a corner, are broken as if every line were shifted by the same infinitesimal
// way.
std::vector<int16_t> windingNumbers(const Mesh& mesh, const SampleGrid& grid, int threads);

}  // namespace shoal
