// Both forms of the fused path steer schools once a frame, before the fused step. Method and equations:
// docs/school.md; what there is: compile/school_plan.h.
//
//   school grid    bodies    place, velocity, axes and turning of every molecule, from the state
//                  keys      of its cell, in every grid that it is in
//                  sort      ascending, all grids at once
//                  order     places and velocities in that order; where each key begins
//   school steer   steer     from what each sees: an acceleration, a turn, a bend and the rate of its muscles
//
// Only gathers: a repeat gives the same bits. What it keeps from one frame to the next, the smoothed steering
// and the muscles' clocks, is part of the state (GroupState::steering).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/arrays.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/packed_state.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

class SchoolPasses {
  public:
    virtual ~SchoolPasses() = default;
    // Other numbers for a group's school, from the next step on. False, and nothing changes: it has none, or
    // what differs needs another plan (whom it flees or hunts, whether there are walls).
    bool change(size_t group, const School& school);
    // Steers all molecules for this frame.
    void step(const Frame& frame, gpu::PassTimers& timers);

  protected:
    using Form = gpu::ArrayTable::Form;

    // Borrows the plan and the tables. Error, located at the first school: more than `most` molecules or
    // entries; out of memory.
    SchoolPasses(gpu::Context& context, const Plan& plan, const Tables& tables, Form form, size_t most);

    // In use, with their numbers and all arrays.
    const gpu::Program& useKeys() const;
    const gpu::Program& useSteer(size_t member, const Frame& frame) const;
    glm::ivec4 rangeOf(size_t grid) const;  // first slot, slots, first key, keys
    double cellOf(size_t grid) const;       // m
    // The files and defines of a program of this form; `group`: whose state it reads.
    gpu::ProgramOptions optionsOf(const std::string& file, const std::string& label,
                                  const GroupPlan* group) const;

    gpu::Context* context_;
    const Plan* plan_;
    const SchoolPlan* school_;
    gpu::ArrayTable table_;
    int rowBits_;  // of textures
    gpu::Arrays arrays_;

  private:
    virtual const PackedState& stateOf(size_t group) const = 0;
    virtual void sortKeys() = 0;
    virtual void steer(size_t member, const Frame& frame) = 0;

    struct Member {
        const gpu::Program* steer;
        School school;
    };

    void findBodies(size_t index);
    void makeSteer(const SchoolMember& member);
    void setRules(size_t member, const Frame& frame) const;
    bool hasTextures() const { return table_.form() == Form::textures; }

    const Tables* tables_;
    gpu::Programs programs_;
    std::vector<const gpu::Program*> bodyPrograms_;  // one a SchoolBodies
    std::vector<Member> members_;
    gpu::Program keys_, order_;
};

}  // namespace shoal
