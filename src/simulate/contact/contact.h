// Contact of molecules with one another, between two dispatches of the step or two substeps, on every path:
// the grid (simulate/contact/grid.h), the search (finder.h), the response (solver.h), and what rests
// (rest.h). Method and equations: docs/contact.md; what there is: compile/contact_plan.h; what it keeps:
// shaders/contact/arrays.txt.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/pass_timers.h"
#include "simulate/contact/data.h"
#include "simulate/contact/finder.h"
#include "simulate/contact/grid.h"
#include "simulate/contact/rest.h"
#include "simulate/contact/solver.h"
#include "simulate/execution_path.h"

namespace shoal {

class Contact : public ContactResult {
  public:
    // Borrows the plan, the tables and the state. Error: more spheres than the context can hold, with how
    // many it can; out of memory.
    Contact(gpu::Context& context, const Plan& plan, const Tables& tables, ContactState& state,
            std::optional<bool> asOnGpu = {});

    // Before the step of all groups.
    void begin(const Frame& frame);
    // Spheres that touch are pushed apart and bounce, rub and rest, in the current side of the state.
    // `frame`: the substeps since the last contact step.
    void step(const Frame& frame, gpu::PassTimers& timers);
    // Gives the step of a group of the plan, from this molecule on, what its contacts remember, if it has
    // any.
    void bindLoads(const gpu::Program& program, size_t group, int firstMolecule = 0) const;

    uint32_t dropped() const override;
    ContactConvergence convergence() const override { return solver_.convergence(); }
    int listLength() const override { return data_.listLength; }
    std::vector<std::pair<int, int>> found() const override;
    ContactMemory memory() const override;
    void remember(const ContactMemory& memory);
    size_t bytes() const override { return data_.arrays.bytes() + grid_.bytes(); }
    int dispatches() const override { return dispatches_; }

  private:
    ContactData data_;
    ContactGrid grid_;
    ContactFinder finder_;
    ContactSolver solver_;
    std::optional<ContactRest> rest_;
    int dispatches_ = 0;
};

}  // namespace shoal
