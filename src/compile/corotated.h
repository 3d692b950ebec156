// The matrix that all molecules of a type share in bdf2-corotated (shaders/solver/bdf2-corotated.glsl):
//
//   A = beta M + sum over the springs of (k + c/eta) n n^T in the rest shape,   beta = 1/eta^2 + gamma/eta
//
// of 3V rows, of which the pinned vertices' are left out. Symmetric, so that its inverse is kept as the 3x3
// blocks of its lower half: block (i, j), j <= i, is number i (i + 1) / 2 + j, nine floats column by column,
// without gaps.
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
    bool held = true;                   // pinned vertices hold
    bool operator==(const CorotatedStage&) const = default;
};

// The inverse in 4-vectors, as the uniform block has it; computed in double. Blocks of pinned vertices are 0.
std::vector<glm::vec4> corotatedInverse(const Molecule& molecule, const CorotatedStage& stage);

// 4-vectors of the block.
int corotatedBlockSize(int vertices);

// The largest molecule whose matrix fits a uniform block of so many bytes.
int largestCorotated(int blockBytes);

// generated/corotated.glsl: the block, applyInverse() on it, the rest shape for the fit, stageForces().
std::string corotatedText(const Molecule& molecule, bool held);

}  // namespace shoal
