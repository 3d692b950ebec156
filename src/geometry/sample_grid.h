// A grid of samples around a mesh, and what is computed on it: winding numbers, and distances continued over
// samples that have none of their own.
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

// How often a closed mesh winds around each sample: 0 outside, 1 inside, 2 where two shells overlap.
//
// Along all lines of the grid in x, in y and in z the triangles' crossings are counted, each by its side; a
// sample takes the middle one of its three counts, so that a line that rounding misled is outvoted. Ties,
// where a line meets an edge or a corner, are broken as if every line were shifted by the same infinitesimal
// way.
std::vector<int16_t> windingNumbers(const Mesh& mesh, const SampleGrid& grid, int threads);

// Solves |grad d| = 1 inwards (d negative) for the samples that are marked, from all others, by fast sweeping
// [Zhao 2005]: of first order in the cell.
void continueInwards(std::vector<float>& distances, const std::vector<char>& marked, const SampleGrid& grid);

}  // namespace shoal
