// Birth and death in fragments (simulate/birth_passes.h): the state tells who died and which places are free
// (simulate/texture_places.h), and a newborn is a vertex, drawn as a point onto its place in the side of the
// state that the step has just written.
#pragma once

#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/pass_timers.h"
#include "gpu/texture.h"
#include "simulate/birth_passes.h"
#include "simulate/layer_state.h"
#include "simulate/tables.h"
#include "simulate/texture_places.h"

namespace shoal {

class TextureBirths : public BirthPasses {
  public:
    // Borrows all but the string. A draw writes at most so many `targets`. Error: out of memory.
    TextureBirths(gpu::Context& context, const Plan& plan, const Tables& tables, int targets);

    // The step of a group with life: what growOlder() needs, and the places that it covers, as far as the CPU
    // knows. Returns how many vertices its draw has.
    int bindStep(const gpu::Program& program, size_t group) const;
    int reach(size_t group) const { return reachOf(*groups_[group]); }
    // After the step of all groups: who is born in it.
    void step(const Frame& frame, std::vector<GroupLayers>& state, gpu::PassTimers& timers);

    // These write and read the part of a group's state that lies here; `time`: of the state, s.
    void write(size_t group, const GroupState& state, double time);
    void read(size_t group, GroupState& state) const;
    // Waits; reads 128 bytes of control.
    LifeCounts counts(size_t group, const GroupLayers& state);

  private:
    struct Own {
        gpu::Texture places;  // list
        gpu::Framebuffer newPlaces;
        const gpu::Program* spawn = nullptr;
    };
    void make(const Living& living, int targets);
    void listDeaths(const std::vector<GroupLayers>& state);
    // Returns how many may be born, at most.
    int allocate(const Living& living, const Newborns& newborns, const GroupLayers& state);
    void spawn(Living& living, const Frame& frame, std::vector<GroupLayers>& state);
    void bindBirths(const gpu::Program& program, const Living& living,
                    const std::vector<GroupLayers>& state) const;

    gpu::Context* context_;
    const Tables* tables_;
    std::vector<Own> own_;  // of the plan's groups
    TexturePlaces places_;
    gpu::Texture died_;  // lists of deaths
    gpu::Framebuffer newDied_;
};

}  // namespace shoal
