// Birth and death in compute shaders (simulate/birth_passes.h). What dies sets the bit of its place; lists
// come from sums over the bits (count, scan, list); a lane spawns a newborn. With the allocator gpu, how far
// the next step and birth have to reach is known on the GPU alone, too.
#pragma once

#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
#include "simulate/birth_passes.h"
#include "simulate/buffer_state.h"
#include "simulate/tables.h"

namespace shoal {

class Births : public BirthPasses {
  public:
    // Borrows all but the strings and vectors. Of each group: its state, and as `together` the molecules that
    // a workgroup of its step takes. `listWords`: the words of a list that one dispatch may read. Error,
    // located at the group: a storage block does not hold a bit for each of its places.
    Births(gpu::Context& context, const Plan& plan, const Tables& tables,
           const std::vector<GroupBuffers>& state, const std::vector<int>& together, size_t listWords);

    // The step of a part of a group with life: what growOlder() needs, and as many workgroups as there are
    // lives.
    void bindStep(const gpu::Program& program, size_t group, const GroupBuffers::Part& part) const;
    void dispatchStep(const gpu::Program& program, size_t group, const GroupBuffers::Part& part) const;
    // After the step of all groups: who is born in it.
    void step(const Frame& frame, std::vector<GroupBuffers>& state, gpu::PassTimers& timers);

    // These write and read the part of a group's state that lies here; `time`: of the state, s.
    void write(size_t group, const GroupState& state, double time);
    void read(size_t group, GroupState& state) const;

    // Waits; reads 128 bytes of control.
    LifeCounts counts(size_t group);

  private:
    struct Buffers {
        gpu::Buffer free, died, places;  // bits, bits, list
        gpu::Buffer stepGroups;          // of each part
        std::vector<ListRange> ranges;   // of a list of places
        PlaceSet set;
        const gpu::Program* spawn = nullptr;  // none: nothing is born
    };
    void make(const Living& living, const GroupBuffers& state, int together);
    void countPlaces(const Living& living, int scheduled, bool allocates);
    void spawn(Living& living, const Frame& frame, std::vector<GroupBuffers>& state);
    std::vector<ListRange> rangesOf(size_t words) const;
    void bindBirths(const Living& living) const;
    // Binds what a dispatch reads of those from whose deaths others are born: one range of the deaths, and
    // the part with that index of each source's state.
    void bindSources(const Living& living, const ListRange& deaths, size_t index,
                     const std::vector<GroupBuffers>& state) const;
    void dispatchBirths(const Living& living, int born, const GroupBuffers& state) const;

    gpu::Context* context_;
    const Tables* tables_;
    std::vector<Buffers> buffers_;  // of the plan's groups
    PlaceLists lists_;
    size_t listWords_;
    gpu::Buffer died_;  // lists of deaths
};

}  // namespace shoal
