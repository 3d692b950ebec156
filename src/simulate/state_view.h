// Where a renderer finds the current state: in the textures of the ping-pong path or the buffers of the fused
// one.
#pragma once

#include <vector>

#include "simulate/buffer_state.h"
#include "simulate/texture_state.h"

namespace shoal {

// Borrows; exactly one of the two is set.
struct StateView {
    const TextureState* textures = nullptr;
    const std::vector<GroupBuffers>* buffers = nullptr;  // per group
};

}  // namespace shoal
