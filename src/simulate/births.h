// Birth and death on the fused path (compile/life_plan.h). The step ends lives (shaders/particles/age.glsl):
// what dies sets the bit of its place. After it:
//
//   deaths   where others emit from them: the bits that were set in this step, as a list
//   places   allocator gpu: the first free places, as many as are asked for
//   births   a lane each; groups that emit from the deaths of others before those emit anew
//
// The lists come from sums over the bits (count, scan, list), in ascending order: the same for the same bits.
// With the allocator gpu, how many are born, where, and how far the next step and birth have to reach is
// known on the GPU alone.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/buffer_state.h"
#include "simulate/execution_path.h"
#include "simulate/fused_kernel.h"
#include "simulate/places.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

class Births {
  public:
    // Borrows all but the strings. Error, located at the group: more places than the context holds.
    Births(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
           gpu::ProgramCache* cache);

    bool has(size_t group) const { return bool(groups_[group]); }
    // The step of a group with life: what growOlder() needs, and as many workgroups as there are lives.
    void bindStep(const gpu::Program& program, size_t group) const;
    void dispatchStep(const gpu::Program& program, size_t group, int lanes) const;
    // After the step of all groups: who is born in it.
    void step(const Frame& frame, std::vector<GroupBuffers>& state, gpu::PassTimers& timers);

    // These write and read the part of a group's state that lies here; `time`: of the state, s.
    void write(size_t group, const GroupState& state, double time);
    void read(size_t group, GroupState& state) const;

    // Waits; reads 128 bytes of control.
    LifeCounts counts(size_t group);
    // Other numbers for the same emitters, from the next frame on. False, and nothing changes: they need
    // another program, or other places.
    bool change(size_t group, const Lifecycle& life);

  private:
    struct Living {
        const GroupPlan* plan;
        Lifecycle life;
        gpu::Buffer free, died, places;  // bits, bits, list
        PlaceSet set;
        size_t diedAt = 0;                    // word of its deaths in died_
        const gpu::Program* spawn = nullptr;  // none: nothing is born
        std::vector<glm::dvec3> middles;      // m, of the emitters
        std::vector<BirthClock> clocks;
        Places book;                  // allocators stack and heap
        uint64_t born = 0, lost = 0;  // of the allocators on the CPU, and born of the ring
        int markBefore = 0;
        struct DeathRun {
            size_t source;
            int emitter, each;
        };
        std::vector<DeathRun> deathRuns;

        Allocator allocator() const { return life.allocator; }
        bool listed() const { return life.allocator != Allocator::ring; }
        bool onGpu() const { return life.allocator == Allocator::gpu; }
    };
    void make(size_t group, const std::string& shaderRoot, gpu::ProgramCache* cache);
    void order();
    void countPlaces(const Living& living, int scheduled, bool allocates);
    // Takes places from an allocator on the CPU and uploads their list; returns how many births have one.
    int takePlaces(Living& living, const std::vector<BirthRun>& runs, double end);
    void spawn(size_t group, const Frame& frame, std::vector<GroupBuffers>& state);
    void setRuns(const Living& living, const std::vector<BirthRun>& runs, double begin) const;
    void setNumbers(size_t group, const Frame& frame) const;
    void bindBirths(size_t group, std::vector<GroupBuffers>& state) const;
    int reachOf(const Living& living) const;
    int markOf(const Living& living) const;
    static uint64_t bornOf(const Living& living, const uint32_t* words);  // `words`: of its control
    static uint64_t lostOf(const Living& living, const uint32_t* words);

    gpu::Context* context_;
    const Plan* plan_;
    const Tables* tables_;
    std::vector<std::unique_ptr<Living>> groups_;  // of the plan; null: without life
    gpu::Programs programs_;
    std::vector<size_t> order_;  // groups that emit, each after those that emit from its deaths
    PlaceLists lists_;
    gpu::Buffer died_;  // lists of deaths
};

}  // namespace shoal
