// Both paths do this in a step of contact between molecules, each with its own passes: the grid, the search,
// and the impulses of all contacts in Jacobi iterations (docs/contact.md).
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compile/plan.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/execution_path.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

// `State`: what the path keeps its state in.
template <typename State>
class ContactPasses : public ContactResult {
  public:
    // Spheres that touch are pushed apart and bounce, rub and rest, in the current side of the state.
    // `frame`: the substeps since the last contact step.
    void step(const Frame& frame, State& state, gpu::PassTimers& timers) {
        {
            const auto timer = timers.time("contact grid");
            buildGrid(frame, state);
        }
        {
            const auto timer = timers.time("contact search");
            search(state);
        }
        const auto timer = timers.time("contact response");
        const double stepTime = frame.parameters.frameTime;
        // what gravity adds in two steps is no bounce
        respond(state, {stepTime, 2 * glm::length(frame.parameters.gravity) * stepTime});
    }

  protected:
    struct Times {
        double step;       // s
        double restSpeed;  // m/s
    };
    // An iteration reads the totals of the two before it, which lie in these.
    struct Totals {
        size_t last = 0, earlier = 1, next = 2;
        float momentum = 0;            // by how much it goes on beyond the last
        std::optional<size_t> pushes;  // where those lie that friction is bounded by
    };

    ContactPasses(const Plan& plan, const Tables& tables)
        : plan_(&plan), contact_(&plan.contact), tables_(&tables) {}

    virtual void buildGrid(const Frame& frame, State& state) = 0;
    virtual void search(State& state) = 0;
    virtual void runNearest(State& state, const Times& times, const Totals& totals) = 0;
    // The effective number of contacts that act on the same vertices.
    virtual void runEffective(State& state, const Times& times) = 0;
    // To the spheres of triangles, what their corners have gained so far.
    virtual void spread(State&, const Totals&) {}
    virtual void runStage(State& state, const gpu::Program& program, const Times& times,
                          const Totals& totals) = 0;
    virtual void apply(State& state, size_t impulses) = 0;  // into the state

    // Makes the programs of the search and of the response; make(file of shaders/contact) takes `options`.
    template <typename Make>
    void makeStages(gpu::ProgramOptions& options, const Make& make) {
        find_ = make(contact_->settings.search == ContactSearch::exact ? "find" : "neighbors");
        if (contact_->settings.response == ContactResponse::nearest) {
            nearest_ = make("nearest");
            return;
        }
        effective_ = make("effective");
        const auto stage = [&](const char* name) {
            options.generated = responseStage(name);
            return make("respond");
        };
        guess_ = stage("guess");
        relax_ = stage("relax");
        friction_ = stage("friction");
        correction_ = stage("correction");
    }

    void setResponse(const gpu::Program& program, const Times& times) const {
        program.set("count", contact_->spheres);
        program.set("cell", float(contact_->cell));
        program.set("groupCount", int(contact_->groups.size()));
        program.set("stepTime", float(times.step));
        program.set("restSpeed", float(times.restSpeed));
    }

    int keyMask() const { return (1 << contact_->tableBits) - 1; }

    // Each pair once, ascending.
    static std::vector<std::pair<int, int>> once(std::vector<std::pair<int, int>> pairs) {
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

    const Plan* plan_;
    const ContactPlan* contact_;
    const Tables* tables_;
    gpu::Program find_, nearest_, effective_, guess_, relax_, friction_, correction_;

  private:
    void respond(State& state, const Times& times) {
        Totals totals;
        if (nearest_) {
            runNearest(state, times, totals);
            return apply(state, totals.next);
        }
        runEffective(state, times);
        const auto run = [&](const gpu::Program& program) {
            runStage(state, program, times, totals);
            totals = {totals.next, totals.last, totals.earlier, 0, totals.pushes};
        };
        run(guess_);
        for (int i = 0; i < contact_->settings.iterations; ++i) {
            totals.momentum = i == 0 ? 0.0f : float(i) / float(i + 3);  // Nesterov's, from rest
            spread(state, totals);
            run(relax_);
        }
        totals.pushes = totals.last;
        for (int i = 0; i < ContactPlan::frictionRounds; ++i) {
            spread(state, totals);
            run(friction_);
        }
        run(correction_);
        apply(state, totals.last);
    }
};

}  // namespace shoal
