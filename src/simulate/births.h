// Births with compute shaders and in fragments (simulate/birth_passes.h).
#pragma once

#include <vector>

#include "simulate/birth_passes.h"
#include "simulate/buffer_state.h"
#include "simulate/layer_state.h"

namespace shoal {

// The step sets the bit of a place in which something dies, and a newborn is a lane. Where states are in
// several parts, a dispatch spawns those whose places lie in one of them.
class BufferBirths : public BirthPasses {
  public:
    // Borrows all. Errors: as of BirthPasses.
    BufferBirths(gpu::Context& context, const Plan& plan, const Tables& tables,
                 const std::vector<GroupBuffers>& state);
    void runStep(const gpu::Program& program, size_t group, size_t range) const override;

  private:
    void bindPlaces(const gpu::Program& bits, const Living& living) const override;
    void writePlaces(const Living& living, const GroupState& state) override;
    void spawn(const gpu::Program& program, const Living& living, int most) override;
    // Binds what a dispatch reads of those from whose deaths others are born: the part with that index of
    // each source's state.
    void bindSources(const gpu::Program& program, const Living& living, size_t index) const;

    const std::vector<GroupBuffers>* state_;
};

// The state tells who died and which places are free, and a newborn is a vertex, drawn as a point onto its
// place in the side of the state that the step has just written.
class TextureBirths : public BirthPasses {
  public:
    // Borrows all. Errors: as of BirthPasses.
    TextureBirths(gpu::Context& context, const Plan& plan, const Tables& tables,
                  const std::vector<GroupLayers>& state);

    void runStep(const gpu::Program& program, size_t group, size_t range) const override;

  private:
    void bindPlaces(const gpu::Program& bits, const Living& living) const override;
    void spawn(const gpu::Program& program, const Living& living, int most) override;

    const std::vector<GroupLayers>* state_;
};

}  // namespace shoal
