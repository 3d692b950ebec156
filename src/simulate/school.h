// Schools on the fused path (OpenGL 4.3): once a frame, before the fused step, what steers every molecule of
// them. Method and equations: docs/school.md; what there is: compile/school_plan.h.
//
//   school grid    bodies    place, velocity, axes and turning of every molecule, from the state
//                  keys      of its cell, in every grid that it is in
//                  sort      ascending, all grids at once (sort/radix_sort.h)
//                  order     places and velocities in that order; where each key begins
//   school steer   steer     from what each sees: an acceleration, a turn, a bend and the rate of its muscles
//
// Only gathers: a repeat gives the same bits. What it keeps from one frame to the next, the smoothed steering
// and the muscles' clocks, is part of the state (GroupState::steering).
#pragma once

#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/buffer_state.h"
#include "simulate/step.h"
#include "simulate/tables.h"
#include "sort/radix_sort.h"

namespace shoal {

class Schooling {
  public:
    // Borrows the plan and the tables. Error: more molecules than the context can hold; out of memory.
    Schooling(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
              gpu::ProgramCache* cache);

    // Steers the molecules of `state` for this frame.
    void step(const Frame& frame, const std::vector<GroupBuffers>& state, gpu::PassTimers& timers);

    // Other numbers for a group's school, from the next step on. False, and nothing changes: it has none, or
    // what differs needs another plan (whom it flees or hunts, whether there are walls).
    bool change(size_t group, const School& school);

  private:
    struct Member {
        const gpu::Program* steer;
        School school;
    };

    void makePrograms(const std::string& shaderRoot, gpu::ProgramCache* cache);
    void makeSteer(const SchoolMember& member, const std::string& shaderRoot, gpu::ProgramCache* cache);
    double cellOf(size_t grid) const;
    void findBodies(const std::vector<GroupBuffers>& state);
    void makeKeys();
    void order();
    void steer(size_t member, const Frame& frame, const std::vector<GroupBuffers>& state);
    void setRules(size_t member, const Frame& frame);

    gpu::Context* context_;
    const Plan* plan_;
    const SchoolPlan* school_;
    const Tables* tables_;
    gpu::Programs programs_;
    std::vector<const gpu::Program*> bodyPrograms_;  // one a SchoolBodies
    std::vector<Member> members_;
    gpu::Program keys_, order_;
    RadixSort sort_;
    gpu::Buffer bodies_, pairs_, starts_, places_, velocities_;
    gpu::BufferTexture bodiesRead_, pairsRead_, startsRead_, placesRead_, velocitiesRead_;
};

}  // namespace shoal
