// The matrix that all molecules of a type share in bdf2-corotated (shaders/solver/bdf2-corotated.glsl):
//
//   A = beta M + sum over the springs of (k + c/eta) n n^T in the rest shape,   beta = 1/eta^2 + gamma/eta
//
// factored as A = L D L^T in 3x3 blocks, one row and column a vertex, L unit lower: a molecule is a chain of
// few neighbours, and its factors keep that, while the inverse is full (24 vertices of the fish: 140 blocks
// against 300). The vertices are eliminated in the order of least degree. Pinned vertices take no part.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "molecule/molecule.h"

namespace shoal {

struct CorotatedStage {
    double eta = 0;                     // s
    double drag = 0;                    // 1/s; of two rates the larger, which makes the steps shorter
    double stiffness = 1, damping = 1;  // factors on every spring
    bool operator==(const CorotatedStage&) const = default;
};

// Which blocks there are. Block number b has floats 9b to 9b + 8, column by column.
struct CorotatedPattern {
    std::vector<int> order;  // vertices, as they are eliminated; without pinned ones
    std::vector<std::vector<int>>
        below;  // for each place in `order`: later places that L joins it to, rising
    std::vector<std::vector<int>> block;  // likewise: the number of that block of L
    std::vector<int> diagonal;            // for each place: the number of its block of D^-1
    int blocks = 0;

    int elements() const { return (9 * blocks + 3) / 4; }  // 4-vectors
};
CorotatedPattern corotatedPattern(const Molecule& molecule, bool held);

// The blocks in 4-vectors; computed in double.
std::vector<glm::vec4> corotatedFactors(const Molecule& molecule, const CorotatedPattern& pattern,
                                        const CorotatedStage& stage);

// Returns the part of generated/sweeps.glsl with the rest shape for the fit, and applyInverse() from a
// `vec4 factors[]`.
std::string corotatedText(const Molecule& molecule, const CorotatedPattern& pattern, bool held);
// These declare that array as a uniform block, or as constants for CPU rasterisers, to which every read of a
// uniform is a call.
std::string corotatedBlock(const CorotatedPattern& pattern);
std::string corotatedConstants(const std::vector<glm::vec4>& factors);

}  // namespace shoal
