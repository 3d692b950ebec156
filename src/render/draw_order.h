// The order in which the molecules of a blended group are drawn: from back to front, by the depth of their
// middles along the view. Made and kept on the GPU; nothing of it crosses the bus.
//
// Pairs of src/sort: the key is the depth as a whole number, the farthest first; the index is the molecule.
//   frame    numbered and sorted anew in every frame: by radix in compute, below OpenGL 4.3 bitonic. Exact.
//   spread   the first frame sorts; every other gives the last order new depths, and takes its share of the
//   passes
//            of odd-even merge sort (Latta, "Building a million particle system", section 3.4.4). Late by up
//            to spreadFrames frames.
//   none     numbered, with depths: for who asks how far a molecule is
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer_texture.h"
#include "molecule/molecule.h"
#include "render/view.h"
#include "simulate/state_view.h"
#include "sort/key_index.h"
#include "sort/network_sort.h"
#include "sort/radix_sort.h"

namespace shoal {

class DrawOrder {
  public:
    // `index` of the group in the plan. Error: more molecules than the context can sort, with how many it
    // can.
    DrawOrder(gpu::Context& context, const std::string& shaderRoot, const GroupPlan& group, size_t index,
              DrawSort sort, int spreadFrames);

    // For the programs that read the order (shaders/render/order.glsl).
    std::vector<std::string> defines() const;
    void bind(const gpu::Program& program) const;

    // Updates the order to the state as `eye` sees it. Changes the framebuffer and what fragment passes
    // change. Error: the group is in several pieces, because its state is larger than a storage block.
    void update(const StateView& state, const Eye& eye);

    std::vector<KeyIndex> download() const;  // for tests
    int count() const { return count_; }
    bool sorted() const { return sort_ != DrawSort::none; }
    bool exact() const { return radix_ != nullptr; }  // sorted in every frame, in a buffer

  private:
    const gpu::Program& keysProgram(const StateView& state);
    void setKeys(const StateView& state, const Eye& eye, bool keepOrder);

    gpu::Context* context_;
    std::string shaderRoot_, name_;
    size_t index_;
    int count_, vertexCount_;
    glm::ivec4 rows_;
    BufferLayout layout_;
    DrawSort sort_;
    int spreadFrames_;
    bool begun_ = false;
    std::array<gpu::Program, 2> keys_;  // for textures, for buffers; made when first needed
    gpu::Buffer pairs_;                 // with compute, unless spread
    gpu::BufferTexture pairTexels_;
    std::unique_ptr<RadixSort> radix_;
    std::unique_ptr<NetworkSort> network_;  // else
};

}  // namespace shoal
