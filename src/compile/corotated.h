// The matrix that all molecules of a type share in bdf2-corotated (shaders/solver/bdf2-corotated.glsl):
//
//   A = beta M + sum over the springs of (k + c/eta) n n^T in the rest shape,   beta = 1/eta^2 + gamma/eta
//
// factored as A = L D L^T, L unit lower (compile/block_pattern.h). Block number b has floats 9b to 9b + 8,
// column by column.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/block_pattern.h"

namespace shoal {

struct CorotatedStage {
    double eta = 0;                     // s
    double drag = 0;                    // 1/s; of two rates the larger, which makes the steps shorter
    double stiffness = 1, damping = 1;  // factors on every spring
    bool operator==(const CorotatedStage&) const = default;
};

// The 4-vectors that hold the blocks' floats.
int corotatedElements(const BlockPattern& pattern);
// The blocks in them; computed in double.
std::vector<glm::vec4> corotatedFactors(const Molecule& molecule, const BlockPattern& pattern,
                                        const CorotatedStage& stage);

// Returns the part of generated/sweeps.glsl with the rest shape for the fit, and applyInverse() from a
// `vec4 factors[]`.
std::string corotatedText(const Molecule& molecule, const BlockPattern& pattern, bool held);
// These declare that array as a uniform block, or as constants for CPU rasterisers, to which every read of a
// uniform is a call.
std::string corotatedBlock(const BlockPattern& pattern);
std::string corotatedConstants(const std::vector<glm::vec4>& factors);

}  // namespace shoal
