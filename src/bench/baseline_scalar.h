// The baseline as one writes it without SIMD in mind: an array of vertices, loops over springs and vertices.
// Compiled with the project's own options; what the compiler vectorises by itself it may.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "bench/baseline.h"

namespace shoal::bench {

struct ScalarVertex {
    glm::vec3 position, velocity;
};

struct ScalarSpring {
    int a, b;
    float stiffness, damping, restLength;
};

struct ScalarMolecules {
    int vertexCount = 0;
    std::vector<ScalarSpring> springs;
    std::vector<float> inverseMass;      // 1/kg, per vertex
    std::vector<ScalarVertex> vertices;  // relative to the anchor, molecule by molecule
    std::vector<glm::vec3> anchors;
};

// Molecules first to last - 1. `force`: one entry a vertex, for the function's own use.
void frameScalar(ScalarMolecules& molecules, int first, int last, const BaselineStep& step,
                 std::span<glm::vec3> force);

}  // namespace shoal::bench
