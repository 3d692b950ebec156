// Levels of detail: a mesh by fewer and fewer of its vertices (quadric edge collapse [Garland 1997], by
// meshoptimizer), with how much of it each leaves out.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// Collapses edges by that metric, to about so many triangles or as far as seams let; `corners`: three a
// triangle. `error`, where asked for: m, how far the result lies off.
std::vector<uint32_t> collapseEdges(const std::vector<uint32_t>& corners,
                                    const std::vector<glm::vec3>& positions, size_t triangles,
                                    double* error = nullptr);

struct MeshLevel {
    std::vector<uint32_t> corners;  // three a triangle
    double error = 0;               // m: how large a pixel has to be for the level to look like the mesh
};

// All of the mesh, then levels of 0.4 times as many triangles as the last, down to 8 or as far as seams let.
// Flat parts may bend in motion, so levels are made of the mesh bent like a bowl as wide as itself. Normals
// count as well: a level's error is at least the RMS deviation of its unit normals times its mean edge.
std::vector<MeshLevel> levelsOf(const std::vector<glm::dvec3>& positions,
                                const std::vector<glm::dvec3>& normals, const std::vector<uint32_t>& corners);

}  // namespace shoal
