// How programs that draw or order molecules reach the state of either path (shaders/state/molecule.glsl).
#pragma once

#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/program.h"
#include "simulate/state_view.h"

namespace shoal {

// Returns the defines of a program that includes state/molecule.glsl.
std::vector<std::string> stateDefines(const StateView& state, const BufferLayout& layout);

// Binds the state of the group at `index`, with texture rows `rows` (first state row, rows of a slab, first
// record row). `part`: of its buffers; null where the state is in textures. Texture units 0 to 3.
void bindState(const gpu::Program& program, const StateView& state, size_t index, const glm::ivec4& rows,
               const GroupBuffers::Part* part);

}  // namespace shoal
