// Contact of molecules with one another on the fused path (OpenGL 4.3): the passes between two dispatches of
// the fused step. Method and equations: docs/contact.md; what there is: compile/contact_plan.h.
//
//   contact grid       spheres   records of every sphere from the state, and the key of its cell
//                      sort      keys ascending: on a CPU rasteriser by sort/radix_sort.h; on a GPU, in fewer
//                                dispatches, by counting: starts, where each cell begins, and members, the
//                                spheres of each cell
//                      order     places in that order
//   contact search     find      the spheres that each touches (or `neighbors`, UberFlow's)
//                      sift      before it, what rests and has touched what is awake
//                      wake      what an impact wakes
//   contact response   prepare   what contacts remember of the last step
//                      relax     the impulses of all contacts, in Jacobi iterations
//                      settle    what they remember for the next (or, of all three, `nearest`: UberFlow's)
//                      apply     into the state
//                      weigh     what pushes on what rests
//                      rest      which molecules rest, and cost nothing more
//
// Only gathers: a repeat gives the same bits.
//
// shaders/contact/records.glsl lists what is known of a sphere.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/named_arrays.h"
#include "simulate/buffer_state.h"
#include "simulate/contact_passes.h"
#include "sort/radix_sort.h"

namespace shoal {

class MoleculeContact : public ContactPasses<const std::vector<GroupBuffers>> {
  public:
    // Borrows the plan and the tables. Error: more spheres than the context can hold, with how many it can;
    // out of memory.
    MoleculeContact(gpu::Context& context, const Plan& plan, const Tables& tables,
                    const SimulationOptions& options);

    // Lists are as long as the plan's, or as the context has room for, but no shorter than this: as many as
    // touch a sphere of their size at once without overlap.
    static constexpr size_t shortestList = 12;
    // Cells that a workgroup adds up (shaders/contact/starts.comp).
    static constexpr size_t cellTile = 1024;
    // Spheres that a context holds, with the shortest lists.
    static size_t most(const gpu::ContextInfo& info, const ContactPlan& contact);

    // Before the step of all groups.
    void begin(const Frame& frame);
    // Binds to the step of a group of the plan what its contacts remember, if it has any.
    void bindLoads(const gpu::Program& program, size_t group, const GroupBuffers::Part& part) const;

    uint32_t dropped() const override;
    int listLength() const override { return listLength_; }
    std::vector<std::pair<int, int>> found() const override;
    ContactMemory memory() const override;
    void remember(const ContactMemory& memory);
    size_t bytes() const override;
    int dispatches() const override { return dispatches_; }

  private:
    using Buffers = const std::vector<GroupBuffers>;
    using Array = gpu::Array;
    struct GroupPrograms {
        gpu::Program spheres, effectiveSum, spread, apply, rest;
        Array shapes;
        // All that acts on its molecules beside contact, and whether it is other than in the last step.
        std::vector<glm::vec4> numbers;
        bool probes = false;
    };

    void makeArrays();
    void makePrograms();
    void makeGroup(const ContactGroup& group);
    void makeExclusions();
    void makeMaterials();

    void buildGrid(const Frame& frame, Buffers& state) override;
    void makeKeys(bool staggered, const Frame& frame, Buffers& state);
    // Uses a program, with all arrays that it declares but those of a part of the state.
    const gpu::Program& with(const gpu::Program& program) const;
    void setWalls(const gpu::Program& program, const ContactGroup& group, const Frame& frame) const;
    void sortKeys(bool staggered);
    void order(bool staggered);
    void search(Buffers& state, const Times& times) override;
    void find(const gpu::Program& program, const Times& times);
    void sift();
    void wake();
    struct SphereRange {
        int first = 0, count = 0;
    };
    size_t setSpheres(const gpu::Program& program, const SphereRange& range) const;
    const gpu::Program& withResponse(const gpu::Program& program, const Times& times) const;
    void runNearest(Buffers& state, const Times& times) override;
    void prepare(Buffers& state, const Times& times) override;
    void countEffective(Buffers& state);
    void relax(Buffers& state, const Times& times, int iteration) override;
    void spread(Buffers& state, const Array& earlier, float momentum);
    void settle(Buffers& state, const Times& times) override;
    void apply(Buffers& state, const Times& times) override;
    void rest(Buffers& state, const Times& times) override;
    void weigh(const Times& times);
    bool rests() const { return contact_->settings.rest.has_value(); }
    float wakeSpeed(const Times& times) const;
    // run(number of the group with contact, its buffers, part, the part's spheres)
    template <typename Run>
    void forParts(Buffers& state, const Run& run) {
        for (size_t g = 0; g < groups_.size(); ++g) {
            const ContactGroup& group = contact_->groups[g];
            for (const GroupBuffers::Part& part : state[group.group].parts())
                run(g, state[group.group], part,
                    SphereRange{group.firstSphere + part.first * group.spheresOf,
                                part.count * group.spheresOf});
        }
    }
    // Runs a stage that knows of a rigid body no more than its spheres, once for all groups whose bodies have
    // equally many: a dispatch takes a GPU longer than what it does for a few. run(the first group, part,
    // spheres)
    template <typename Run>
    void forBodies(Buffers& state, const Run& run) {
        size_t group = 0;
        const GroupBuffers::Part* of = nullptr;
        SphereRange range;
        forParts(state,
                 [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, const SphereRange& more) {
                     if (of && isRigid(group) && isRigid(g) && range.first + range.count == more.first &&
                         contact_->groups[group].spheresOf == contact_->groups[g].spheresOf) {
                         range.count += more.count;
                         return;
                     }
                     if (of) run(group, *of, range);
                     group = g, of = &part, range = more;
                 });
        if (of) run(group, *of, range);
    }
    // Where the workgroups of markGroups_ begin, in bytes.
    static constexpr size_t ofAwake = 0, ofMarked = 3 * sizeof(uint32_t), ofStruck = 6 * sizeof(uint32_t);
    static void settled();  // before what reads what dispatches have written
    void dispatch(const gpu::Program& program, size_t lanes) const;
    void dispatchTouching(const gpu::Program& program) const;
    void dispatchBodies(const gpu::Program& program, size_t group, const SphereRange& range) const;

    gpu::Context* context_;
    mutable int dispatches_ = 0;
    bool counted_;   // the keys are sorted by counting
    size_t padded_;  // spheres, to whole workgroups
    std::vector<GroupPrograms> groups_;
    gpu::Program starts_, collect_, order_, find_, findStaggered_, findResting_, sift_, wake_, weigh_,
        nearest_, prepare_, relaxFirst_, relax_, settle_;
    bool wakes_ = false;  // all that rests, in this step
    int listLength_;
    std::optional<RadixSort> sort_;  // where they are not counted
    gpu::NamedArrays arrays_;        // all below, by their names in the shaders (makeArrays)

    // Of the grid: made anew in each step.
    Array spherePlaces_, sphereCells_, motions_;  // shaders/contact/records.glsl
    Array pairs_, staggered_, cellStarts_;        // keys and spheres, sorted; where each key begins
    Array arrivals_, members_;                    // where they are counted instead of sorted
    gpu::Buffer cellCounts_;                      // shaders/contact/cell_counts.glsl
    Array places_, cells_, slots_;                // in the order of the slots; the slot of each sphere
    // Of the plan: never changed.
    Array apart_, groupsOf_, materials_;
    // The last step leaves these to this one, by sphere (shaders/contact/memory.glsl).
    Array partners_, oldPushes_, oldAnchors_, known_, wallPushes_;
    Array loads_;  // m/s^2, and in w what shaders/contact/apply.comp says
    Array calm_;   // shaders/contact/rest.comp
    // Within a step.
    Array counts_, lists_, anchors_, nearWalls_, bodies_;
    Array normals_, amounts_;                 // shaders/contact/constraint.glsl
    Array marks_, markedSlots_, awakeSlots_;  // shaders/contact/marks.glsl
    gpu::Buffer markGroups_;                  // shaders/contact/marked.glsl
    std::array<Array, 2> pushes_;             // in turn: the last iteration's, those before
    std::array<Array, 3> totals_;             // in turn: the last stage's, those before, the next
    std::array<Array, 2> motionsNow_;         // in turn: this iteration's, the next's
    Array effectiveCounts_, contactSums_;
    gpu::Buffer touching_, touchingGroups_;  // shaders/contact/touching.glsl
    gpu::Buffer dropped_;                    // contacts that no list had room for, so far
};

}  // namespace shoal
