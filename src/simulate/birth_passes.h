// Both forms of the fused path share this of birth and death (compile/life_plan.h): when who is born, the
// allocators on the CPU, and the numbers that the programs of births are given. The step ends lives
// (shaders/particles/age.glsl). After it:
//
//   deaths   where others emit from them: the places of those that died in this step, as a list
//   places   allocator gpu: the first free places, as many as are asked for
//   births   one after another; groups that emit from the deaths of others before those emit anew
//
// The lists are in ascending order. With the allocator gpu, how many are born and where is known on the GPU
// alone, in words of control, so many a group (shaders/births/control.glsl).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/program.h"
#include "simulate/execution_path.h"
#include "simulate/fused_kernel.h"
#include "simulate/places.h"
#include "simulate/step.h"

namespace shoal {

class BirthPasses {
  public:
    bool has(size_t group) const { return bool(groups_[group]); }
    // Other numbers for the same emitters, from the next frame on. False, and nothing changes: they need
    // another program, or other places.
    bool change(size_t group, const Lifecycle& life);

  protected:
    struct DeathRun {
        size_t source;  // a group
        int emitter, each;
    };
    struct Living {
        const GroupPlan* plan;
        size_t group;
        Lifecycle life;
        std::vector<glm::dvec3> middles;  // m, of the emitters
        std::vector<BirthClock> clocks;
        Places book;                  // allocators stack and heap
        uint64_t born = 0, lost = 0;  // of the allocators on the CPU, and born of the ring
        int markBefore = 0;
        std::vector<DeathRun> deathRuns;
        size_t diedAt = 0;  // where its deaths are, in the list of all

        Allocator allocator() const { return life.allocator; }
        bool emits() const { return plan->life->emits(); }
        bool listed() const { return allocator() != Allocator::ring; }
        bool onGpu() const { return emits() && allocator() == Allocator::gpu; }
        bool booked() const { return emits() && listed() && !onGpu(); }
        int count() const { return plan->count; }
    };
    // Births of one step, as far as the CPU knows them.
    struct Newborns {
        std::vector<BirthRun> runs;
        int scheduled = 0;             // asked for
        int born = 0;                  // allocator gpu: -1
        int firstPlace = 0;            // ring
        std::vector<uint32_t> places;  // stack, heap
    };

    // Borrows the plan. The lists of deaths begin at multiples of `apart`. Error, located: more groups to be
    // born from than a program reads.
    BirthPasses(const Plan& plan, size_t apart);
    ~BirthPasses() = default;

    // Returns the program of a group's births; `targets`: as of KernelOptions. Error: the driver refuses it.
    const gpu::Program& makeSpawn(gpu::Context& context, const Living& living, std::optional<int> targets);

    // All that is scheduled between the ends of the frame, with places from the allocators on the CPU.
    Newborns schedule(Living& living, const Frame& frame);
    void setNumbers(const gpu::Program& spawn, const Living& living, const Newborns& newborns,
                    const Frame& frame) const;
    // Gives a step what growOlder() needs beside the places.
    void setAge(const gpu::Program& step, const Living& living) const;
    // The places that a step covers, of those that the CPU knows: as many as the one before needed, because
    // what died one step ago is still alive on the other side of the state.
    int reachOf(const Living& living) const;
    // For each death run: x the group's first word of control, y births for each of its deaths.
    std::vector<glm::ivec4> deathsOf(const Living& living) const;

    // Begins from a state at a time, s; returns the group's words of control.
    std::vector<uint32_t> begin(Living& living, const GroupState& state, double time);
    // These give what is known with the group's words of control.
    void readBooks(const Living& living, const uint32_t* words, GroupState& state) const;
    LifeCounts countsOf(const Living& living, const uint32_t* words) const;

    const Plan* plan_;
    std::vector<std::unique_ptr<Living>> groups_;  // of the plan; null: without life
    std::vector<size_t> order_;  // groups that emit, each after those that emit from its deaths
    size_t diedWords_ = 0;       // of all lists of deaths

  private:
    gpu::Programs programs_;
    void makeOrder();
    void takePlaces(Living& living, double end, Newborns& newborns);
    int markOf(const Living& living) const;
    static uint64_t bornOf(const Living& living, const uint32_t* words);
    static uint64_t lostOf(const Living& living, const uint32_t* words);
};

}  // namespace shoal
