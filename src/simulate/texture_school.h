// Schools in fragment shaders (simulate/school_passes.h): what is numbered lies in textures, in rows of
// 2^rowBits texels, and a sorting network orders it.
#pragma once

#include <string>
#include <vector>

#include "gpu/arrays.h"
#include "gpu/framebuffer.h"
#include "gpu/texture.h"
#include "simulate/layer_state.h"
#include "simulate/school_passes.h"
#include "sort/network_sort.h"

namespace shoal {

class TextureSchool : public SchoolPasses {
  public:
    // Borrows the plan and the tables. Error: more molecules than the context can hold; out of memory.
    TextureSchool(gpu::Context& context, const Plan& plan, const Tables& tables);

    // Steers the molecules of `state` for this frame; blending, tests and masks are off in it.
    void step(const Frame& frame, std::vector<GroupLayers>& state, gpu::PassTimers& timers);

  private:
    int rowsOf(int numbers) const { return (numbers + (1 << rowBits_) - 1) >> rowBits_; }
    void give(const gpu::Program& program) const;  // all that it declares but the state
    void draw(const gpu::Framebuffer& target, int firstRow, int rows) const;
    void findBodies(const std::vector<GroupLayers>& state);
    void order();
    void steer(size_t member, const Frame& frame, GroupLayers& state);

    int rowBits_;
    NetworkSort sort_;
    gpu::Program starts_, steered_;
    gpu::Texture bodies_, startsOf_, places_, velocities_, slotSteering_;
    gpu::Arrays arrays_;  // all of them, by their names in the shaders
    gpu::Framebuffer newBodies_, newStarts_, newOrder_, newSlotSteering_;
};

}  // namespace shoal
