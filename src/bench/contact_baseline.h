// Contact between molecules, written for the CPU by hand: what `shoal bench collide` compares
// Contact::step with (simulate/contact/contact.h). The same work, and the same equations
// (docs/contact.md): spheres at the vertices from the state, a counting-sorted grid of cells of twice the
// largest distance of a contact that is hashed into a table, the exact search in the eight cells on a
// sphere's side, all contacts of a sphere in one list, what they remember of the last step, the simultaneous
// response in Jacobi iterations, into the state.
//
// Contacts act as a force over the next step by what they remember. Nothing moves here between two steps, and
// so a step ends with what that force will have added to the velocities; the next begins with taking it back,
// as the GPU's does.
//
// Written for speed: arrays in the order of the grid, nothing allocated in a step but where lists grow,
// threads that stay, each with a piece of the spheres. What it has easier than the GPU's passes: positions
// are floats of the world (those are exact however far from the origin), there is one group with one radius,
// lists have no end, and what is known of a contact is kept over the iterations.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "compile/group_state.h"

namespace shoal::bench {

struct ContactBaselineStep {
    float stepTime = 0;   // s, since the last contact step
    float restSpeed = 0;  // m/s: slower is rest
    float restitution = 0.2f, friction = 0.5f;
    int iterations = 4;
    float tolerance = 0;        // at whose residual they end
    bool unlikeMasses = false;  // as the plan of contact has it
};

class ContactBaseline {
  public:
    // weights: 1/mass (1/kg) of a molecule's vertices, 0 where held. At least one thread; those beside the
    // caller's are tied to one core each, the caller's for the time of a step.
    ContactBaseline(std::vector<float> weights, int molecules, float radius, int threads);
    ~ContactBaseline();

    // Nothing is remembered of what was before.
    void set(const GroupState& state);
    // Positions, and velocities with what contacts remember; of the rest nothing changes.
    void get(GroupState& state) const;

    void step(const ContactBaselineStep& step);
    // Contacts that the last step found, as numbers of spheres, the smaller first, ascending; sphere v of
    // molecule m is m * vertices + v.
    std::vector<std::pair<int, int>> found() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace shoal::bench
