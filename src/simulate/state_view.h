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

// The state of molecules where it lies, for shaders of others: a range of a buffer of OpenGL, of 4-vectors.
// Number 3 v + c of a molecule's positions is coordinate c of vertex v, in component (3 v + c) mod 4 of its
// 4-vector e = (3 v + c) / 4; its velocities follow `elements` 4-vectors later. 4-vector e of molecule m,
// from `first` on, is
//   m / 16 * 16 * stride + e * 16 + m mod 16.
// Positions are relative to the molecule's anchor, xyz of 4-vector m of `anchors`.
struct SharedState {
    unsigned buffer = 0, anchors = 0;  // names of buffers
    size_t offset = 0, bytes = 0, anchorOffset = 0, anchorBytes = 0;
    int first = 0, count = 0;      // molecules
    int elements = 0, stride = 0;  // 4-vectors a molecule: of positions; in all
};

// Locates a group's state after the last frame, in as many parts as it is stored in; none where it is not in
// buffers (compute shaders). The next frame writes elsewhere: ask again after each.
std::vector<SharedState> sharedState(const StateView& view, size_t group);

}  // namespace shoal
