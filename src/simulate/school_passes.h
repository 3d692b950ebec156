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
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

class SchoolPasses {
  public:
    // Other numbers for a group's school, from the next step on. False, and nothing changes: it has none, or
    // what differs needs another plan (whom it flees or hunts, whether there are walls).
    bool change(size_t group, const School& school);

  protected:
    // Borrows the plan and the tables. `rowBits`: of the textures in which fragment shaders find what is
    // numbered; without it they are compute shaders and buffers.
    SchoolPasses(gpu::Context& context, const Plan& plan, const Tables& tables, std::optional<int> rowBits);

    void makePrograms();
    // Error, located at the first school: more than `most` molecules or entries.
    static void checkCount(const SchoolPlan& school, size_t most);
    // Return a program, in use, with its numbers.
    const gpu::Program& useBody(size_t bodies) const;
    const gpu::Program& useKeys() const;
    const gpu::Program& useOrder() const;
    const gpu::Program& useSteer(size_t member, const Frame& frame) const;
    glm::ivec4 rangeOf(size_t grid) const;  // first slot, slots, first key, keys
    double cellOf(size_t grid) const;       // m
    // The files and defines of a program of this form; `group`: whose state it reads.
    gpu::ProgramOptions optionsOf(const char* file, const std::string& label, const GroupPlan* group) const;

    gpu::Context* context_;
    const Plan* plan_;
    const SchoolPlan* school_;

  private:
    struct Member {
        const gpu::Program* steer;
        School school;
    };

    void makeSteer(const SchoolMember& member);
    void setRules(size_t member, const Frame& frame) const;

    const Tables* tables_;
    std::optional<int> rowBits_;
    gpu::Programs programs_;
    std::vector<const gpu::Program*> bodyPrograms_;  // one a SchoolBodies
    std::vector<Member> members_;
    gpu::Program keys_, order_;
};

}  // namespace shoal
