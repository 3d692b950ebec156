// Where a renderer finds the current state: in the textures of the ping-pong path, the buffers of the fused
// one or, where it runs in fragments, the layers.
#pragma once

#include <vector>

#include "simulate/buffer_state.h"
#include "simulate/layer_state.h"
#include "simulate/texture_state.h"

namespace shoal {

// Borrows; exactly one of these is set.
struct StateView {
    const TextureState* textures = nullptr;
    const std::vector<GroupBuffers>* buffers = nullptr;  // per group
    const std::vector<GroupLayers>* layers = nullptr;    // per group

    static constexpr size_t forms = 3;
    // The number of the one that is set, for programs that are made for each.
    size_t form() const { return textures != nullptr ? 0 : buffers != nullptr ? 1 : 2; }
};

}  // namespace shoal
