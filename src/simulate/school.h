// Schools with compute shaders (simulate/school_passes.h): what is numbered lies in buffers, and a radix sort
// orders it.
#pragma once

#include <string>
#include <vector>

#include "gpu/arrays.h"
#include "simulate/buffer_state.h"
#include "simulate/school_passes.h"
#include "sort/radix_sort.h"

namespace shoal {

class Schooling : public SchoolPasses {
  public:
    // Borrows the plan and the tables. Error: more molecules than the context can hold; out of memory.
    Schooling(gpu::Context& context, const Plan& plan, const Tables& tables);

    // Steers the molecules of `state` for this frame.
    void step(const Frame& frame, const std::vector<GroupBuffers>& state, gpu::PassTimers& timers);

  private:
    void findBodies(const std::vector<GroupBuffers>& state);
    void makeKeys();
    void order();
    void steer(size_t member, const Frame& frame, const std::vector<GroupBuffers>& state);

    RadixSort sort_;
    gpu::Array bodies_, sorted_, starts_, places_, velocities_;
    gpu::Arrays arrays_;  // all of them, by their names in the shaders
};

}  // namespace shoal
