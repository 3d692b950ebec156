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
    // Borrows the plan and the tables. Error: more molecules than the context can hold; out of memory.
    BufferSchool(gpu::Context& context, const Plan& plan, const Tables& tables);

    // Steers the molecules of `state` for this frame.
    void step(const Frame& frame, const std::vector<GroupBuffers>& state, gpu::PassTimers& timers);

  private:
    void findBodies(size_t bodies) override;
    void sortKeys() override;
    void steer(size_t member, const Frame& frame) override;

    RadixSort sort_;
    const std::vector<GroupBuffers>* state_ = nullptr;
};

class TextureSchool : public SchoolPasses {
  public:
    // Borrows the plan and the tables. Error: more molecules than the context can hold; out of memory.
    TextureSchool(gpu::Context& context, const Plan& plan, const Tables& tables);

    // Steers the molecules of `state` for this frame; blending, tests and masks are off in it.
    void step(const Frame& frame, std::vector<GroupLayers>& state, gpu::PassTimers& timers);

  private:
    void findBodies(size_t bodies) override;
    void sortKeys() override;
    void steer(size_t member, const Frame& frame) override;

    NetworkSort sort_;
    gpu::Program starts_, steered_;
    std::vector<GroupLayers>* state_ = nullptr;
};

}  // namespace shoal
