// What the lanes of a molecule need to factor its matrix in bdf2-newton (shaders/solver/bdf2-newton.glsl).
//
// A = L L^T, whose blocks on the diagonal are kept as their inverses K:
//
//   K(j) = chol(B(j, j))^-1,   L(i, j) = B(i, j) K(j)^T,   B(i, j) = A(i, j) - sum over p before j of L(i, p)
//   L(j, p)^T
//
// so that all blocks of a round can be worked out at once. In doubles: floats lose the masses beside springs
// that are 1e6 times as stiff as m / h^2.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/block_pattern.h"

namespace shoal {

struct GroupPlan;
struct WorkgroupShape;

// The most Newton steps of a substep, and the share of a molecule's size below which one is the last.
constexpr int newtonSteps = 8;
constexpr double newtonSettles = 1e-5;

BlockPattern newtonPattern(const Molecule& molecule, const GroupPlan& group);

// Appends the table of a pattern, whose entries count from its first:
//
//   0               rounds, first entry of the places, first entry of the blocks, newtonSteps
//   1 + v           the block of vertex v on the diagonal (-1: it takes no part), first entry of its springs
//   then a round    first place, end; first block, end
//   then a place    first block, end, vertex; the block on the diagonal comes first
//   then a block    vertex of its row, the block on the diagonal of its column, first entry of its sum, end
//   then a term     the blocks L(i, p) and L(j, p), vertex p
//   then a spring   of each vertex in the order of the topology's entries: the block that it adds to, or -1
void addNewtonTable(const Molecule& molecule, const BlockPattern& pattern, std::vector<glm::vec4>& topology);

// Doubles that a molecule takes while it is worked on.
int newtonNumbers(const GroupPlan& group);
// Turns of loops that a lane takes in a substep, at most.
int newtonTurns(const GroupPlan& group, const WorkgroupShape& shape);
// The names that the shader asks for; of other solvers none.
std::vector<std::string> newtonDefines(const GroupPlan& group);

}  // namespace shoal
