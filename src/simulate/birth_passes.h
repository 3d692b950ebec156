// Birth and death (compile/life_plan.h) in both forms of the fused path. The step ends lives
// (shaders/particles/age.glsl). After it:
//
//   deaths   where others emit from them: the places of those that died in this step, as a list
//   places   allocator gpu: how many of the newborn find a place, which are the first free ones
//   spawn    the newborn, one group after another; groups that emit from the deaths of others before those
//            emit anew
//
// Deaths and free places are bits of a tree of sums (shaders/births/tree.glsl), down which a place is found
// by its rank. How many are born by the allocator gpu, and where, is known on the GPU alone, in words of
// control (shaders/births/control.glsl).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/arrays.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/execution_path.h"
#include "simulate/fused_kernel.h"
#include "simulate/places.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

constexpr int mostGroups = 65535;  // that any device takes in one direction of a dispatch

class BirthPasses {
  public:
    virtual ~BirthPasses() = default;
    bool has(size_t group) const { return bool(groups_[group]); }
    // Runs the step of a range of a group with life, a program in use that has been given all but what
    // growOlder() needs, as far as there are lives.
    virtual void runStep(const gpu::Program& program, size_t group, size_t range) const = 0;
    // After the step of all groups: who is born in it.
    void step(const Frame& frame, gpu::PassTimers& timers);
    // These write and read the part of a group's state that lies here; `time`: of the state, s.
    void write(size_t group, const GroupState& state, double time);
    void read(size_t group, GroupState& state) const;
    // Waits; reads 128 bytes of control.
    LifeCounts counts(size_t group);
    // Other numbers for the same emitters, from the next frame on. False, and nothing changes: they need
    // another program, or other places.
    bool change(size_t group, const Lifecycle& life);

  protected:
    using Form = gpu::ArrayTable::Form;
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
        Places book;                       // allocators stack and heap
        uint64_t born = 0, lost = 0;       // of the allocators on the CPU, and born of the ring
        std::array<int, 2> marksBefore{};  // one step and two steps before
        std::vector<DeathRun> deathRuns;
        int firstDeath = 0, firstWord = 0;  // in the lists of deaths, and in the bits of all groups
        glm::ivec4 parts{0, 0, 1, 1};  // of its state: the first, how many, places of each, of a workgroup
        std::vector<glm::ivec4> tree;  // of each level: where it begins, how many fours of nodes
        const gpu::Program* bits = nullptr;
        const gpu::Program* spawn = nullptr;  // null: nothing is born

        Allocator allocator() const { return life.allocator; }
        bool emits() const { return plan->life->emits(); }
        bool listed() const { return allocator() != Allocator::ring; }
        bool onGpu() const { return emits() && allocator() == Allocator::gpu; }
        bool booked() const { return emits() && listed() && !onGpu(); }
        int count() const { return plan->count; }
        int words() const { return 4 * tree[0].y; }  // of bits
        int levels() const { return int(tree.size()) - 1; }
    };

    // Borrows the plan and the tables. `parts`: of each group's state, as Living has it. Error, located at
    // the group: more groups to be born from than a program reads; more places than a storage block has bits
    // for or a list holds.
    BirthPasses(gpu::Context& context, const Plan& plan, const Tables& tables, Form form,
                std::vector<glm::ivec4> parts);

    // Gives a step what growOlder() needs beside the places.
    void setAge(const gpu::Program& step, const Living& living) const;
    // The places that a step covers, of those that the CPU knows: as many as the two before needed. What died
    // one step ago is still alive on the other side of the state, and an age in float may end a step after
    // the CPU has freed the place.
    int reachOf(const Living& living) const;

    const Plan* plan_;
    std::vector<std::unique_ptr<Living>> groups_;  // of the plan; null: without life
    gpu::ArrayTable table_;
    gpu::Arrays arrays_;

  private:
    // Births of one step, as far as the CPU knows them.
    struct Newborns {
        std::vector<BirthRun> runs;
        int scheduled = 0;             // asked for
        int born = 0;                  // allocator gpu: -1
        int firstPlace = -1;           // ring
        std::vector<uint32_t> places;  // stack, heap
    };
    enum class Renewal { deaths, cuts, births, counts };  // of shaders/births/control.pass.glsl

    // Gives the pass that makes a group's bits what they are made from.
    virtual void bindPlaces(const gpu::Program& bits, const Living& living) const = 0;
    // The group's bits begin as a state has them.
    virtual void writePlaces(const Living&, const GroupState&) {}
    // Runs a program that has been given all but the state for so many newborns, at most.
    virtual void spawn(const gpu::Program& program, const Living& living, int most) = 0;

    std::vector<std::unique_ptr<Living>> makeGroups(const std::vector<glm::ivec4>& parts, Form form) const;
    gpu::ArraySizes sizes(const gpu::ContextInfo& info, Form form) const;
    void makeOrder();
    void makePrograms(gpu::Context& context);
    void begin();
    // Sums over so many places of a group from the first one on, around the capacity, after a step: the free
    // ones, or those in which a molecule died.
    void sum(const Living& living, bool ofDeaths, int firstPlace, int count);
    void setTree(const gpu::Program& program, const Living& living) const;
    void renew(const Living& living, Renewal renewal, int summed, int scheduled = 0);
    void listDeaths(const Living& living);
    void bear(Living& living, const Frame& frame);
    // All that is scheduled between the ends of the frame, with places from the allocators on the CPU.
    Newborns schedule(Living& living, const Frame& frame);
    void takePlaces(Living& living, double end, Newborns& newborns);
    int mostBorn(const Living& living, const Newborns& newborns) const;
    void setNumbers(const Living& living, const Newborns& newborns, const Frame& frame) const;
    int markOf(const Living& living) const;
    LifeCounts countsOf(const Living& living) const;

    const Tables* tables_;
    std::vector<size_t> order_;  // groups that emit, each after those that emit from its deaths
    gpu::Programs programs_;
    gpu::Program sums_, control_, list_;
};

namespace control {
constexpr size_t words = 32;  // a group, as shaders/births/control.glsl names them
constexpr size_t live = 3, mark = 4, lost = 6, bornEver = 7, birthGroups = 8;
}  // namespace control

}  // namespace shoal
