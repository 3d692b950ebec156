// Schools with compute shaders and in fragments (simulate/school_passes.h).
#pragma once

#include <vector>

#include "gpu/framebuffer.h"
#include "simulate/buffer_state.h"
#include "simulate/layer_state.h"
#include "simulate/school_passes.h"
#include "sort/network_sort.h"
#include "sort/radix_sort.h"

namespace shoal {

class BufferSchool : public SchoolPasses {
  public:
    // Borrows all but the context. Error: more molecules than the context can hold; out of memory.
    BufferSchool(gpu::Context& context, const Plan& plan, const Tables& tables,
                 const std::vector<GroupBuffers>& state);

  private:
    const PackedState& stateOf(size_t group) const override { return (*state_)[group]; }
    void sortKeys() override;
    void steer(size_t member, const Frame& frame) override;

    RadixSort sort_;
    const std::vector<GroupBuffers>* state_;
};

class TextureSchool : public SchoolPasses {
  public:
    // Borrows all but the context. Error: more molecules than the context can hold; out of memory.
    TextureSchool(gpu::Context& context, const Plan& plan, const Tables& tables,
                  std::vector<GroupLayers>& state);

  private:
    const PackedState& stateOf(size_t group) const override { return (*state_)[group]; }
    void sortKeys() override;
    void steer(size_t member, const Frame& frame) override;

    NetworkSort sort_;
    gpu::Program starts_, steered_;
    std::vector<GroupLayers>* state_;
};

}  // namespace shoal
