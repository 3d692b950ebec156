// The response of contact (shaders/contact/response): the impulses of all contacts, in Jacobi iterations.
//
//   choose, strike  impacts in their order, where no sphere's contacts move others
//   prepare         the impulse with which each contact begins, from what it remembers
//   effective_sum   by how many contacts each step is divided, where contacts of several spheres act together
//   constrain       what the iterations ask of a contact (with buffers, in the first of them)
//   solve           one iteration, after velocities where one sphere's contacts move others
//   residual        what a batch of iterations leaves (with buffers, in solve)
//   store           what contacts remember for the next step (of all these, UberFlow's response has nearest)
//   apply           into the state (in fragments gains, and then a pass of the path)
//
// Only gathers: a repeat gives the same bits.
#pragma once

#include <vector>

#include "simulate/contact/data.h"
#include "simulate/execution_path.h"

namespace shoal {

class ContactSolver {
  public:
    explicit ContactSolver(ContactData& data);
    void run(const ContactStep& times);
    // Of the last step.
    ContactConvergence convergence() const;

  private:
    // A batch of iterations: shaders/contact/response/batches.glsl.
    struct Iteration {
        int number, batch;
        bool endsBatch;
        float momentum, nextMomentum;
    };
    static constexpr size_t batchBytes = 4 * sizeof(uint32_t);

    struct Group {
        gpu::Program effectiveSum, velocities, apply;
    };

    // Visits the parts of all groups, but those of groups whose rigid bodies have equally many spheres once
    // together: a dispatch takes a GPU longer than what it does for a few. visit(number of the group with
    // contact, part, spheres)
    template <typename Visit>
    void forBodies(const Visit& visit) const;
    // A lane a sphere, or a rigid body.
    void runBodies(const gpu::Program& program, const ContactGroup& group,
                   const ContactData::Spheres& spheres);
    void runEntries(const gpu::Program& program);  // in fragments

    void strike(const ContactStep& times);
    void prepare(const ContactStep& times);
    void countEffective();
    Iteration iteration(int number) const;
    void iterate(const ContactStep& times);
    void solve(const ContactStep& times, const Iteration& iteration);
    void findVelocities(const Iteration& iteration);
    void store(const ContactStep& times);
    void apply(const ContactStep& times);
    void applyGains(const ContactStep& times);

    ContactData* data_;
    std::vector<Group> groups_;
    gpu::Program nearest_, chooseFirst_, choose_, strike_, prepareEntries_, prepare_, constrain_,
        solveEntries_, solveFirst_, solve_, residual_, store_;
    ContactConvergence inFragments_;
};

}  // namespace shoal
