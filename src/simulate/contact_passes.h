// All paths do this in a step of contact between molecules, each with its own passes: the grid, the search,
// and the impulses of all contacts in Jacobi iterations (docs/contact.md).
#pragma once

#include <algorithm>
#include <cstdint>
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
        const double stepTime = frame.parameters.frameTime;
        // what gravity adds in two steps is no bounce
        const Times times = {stepTime, 2 * glm::length(frame.parameters.gravity) * stepTime, frame.h};
        {
            const auto timer = timers.time("contact search");
            search(state, times);
        }
        const auto timer = timers.time("contact response");
        respond(state, times);
    }

  protected:
    struct Times {
        double step;       // s
        double restSpeed;  // m/s
        double substep;    // s
    };
    // In a slot's count: its contacts, and that a collider may hold it (shaders/contact/flags.glsl).
    static constexpr uint32_t contactsMask = 0x1fffffffu, heldFlag = 0x20000000u;

    // `fused`: the state is that of the fused step.
    ContactPasses(const Plan& plan, const Tables& tables, bool fused)
        : plan_(&plan), contact_(&plan.contact), tables_(&tables) {
        for (const ContactGroup& group : contact_->groups) {
            self_ |= group.self;
            if (!contact_->remembers()) continue;
            rigid_ |= plan.groups[group.group].rigid;
            spreads_ |= group.triangles || plan.groups[group.group].rigid;
            walls_ |= fused && plan.groups[group.group].needs.collide;
        }
    }

    virtual void buildGrid(const Frame& frame, State& state) = 0;
    virtual void search(State& state, const Times& times) = 0;
    virtual void runNearest(State& state, const Times& times) = 0;
    // The stages of shaders/contact/respond.glsl.
    virtual void prepare(State& state, const Times& times) = 0;
    virtual void relax(State& state, const Times& times, int iteration) = 0;
    virtual void settle(State& state, const Times& times) = 0;
    virtual void apply(State& state, const Times& times) = 0;  // into the state
    virtual void rest(State&, const Times&) {}                 // what stays where it is

    void setResponse(const gpu::Program& program, const Times& times) const {
        program.set("count", contact_->spheres);
        program.set("cell", float(contact_->cell));
        program.set("groupCount", int(contact_->groups.size()));
        setTimes(program, times);
    }

    // Returns the defines of all programs of the search and of the response, for lists of so many contacts.
    std::vector<std::string> defines(int listLength) const {
        std::vector<std::string> out = {
            concat("LIST ", listLength), concat("NEIGHBORS ", contact_->settings.neighbors),
            concat("NEAR ", ContactPlan::near), concat("MOST_WALLS ", ContactPlan::mostWalls)};
        const auto define = [&](bool need, const char* name) {
            if (need) out.emplace_back(name);
        };
        define(contact_->settings.fastest.has_value(), "SWEPT");
        define(self_, "SELF");
        define(spreads_, "SPREAD");
        define(rigid_, "BODIES");
        define(walls_, "WALLS");
        define(contact_->remembers(), "REMEMBERS");
        return out;
    }

    // `group`: among those with contact.
    bool isRigid(size_t group) const { return rigid_ && plan_->groups[contact_->groups[group].group].rigid; }

    static void setTimes(const gpu::Program& program, const Times& times) {
        program.set("stepTime", float(times.step));
        program.set("restSpeed", float(times.restSpeed));
    }

    float momentum(int iteration) const {
        return ContactPlan::momentum(iteration, contact_->settings.iterations);
    }

    int keyMask() const { return (1 << contact_->tableBits) - 1; }

    // Returns each pair of touching spheres once, ascending. `counts` and `lists` are by slot, of which entry
    // e of slot s lies at e * stride + s; `spheres`: of the slots that are taken.
    static std::vector<std::pair<int, int>> pairsOf(const std::vector<uint32_t>& counts,
                                                    const std::vector<uint32_t>& lists, size_t stride,
                                                    const std::vector<uint32_t>& spheres) {
        std::vector<std::pair<int, int>> out;
        for (size_t slot = 0; slot < spheres.size(); ++slot) {
            const size_t listed = std::min(size_t(counts[slot] & contactsMask), lists.size() / stride);
            for (size_t e = 0; e < listed; ++e)
                out.emplace_back(std::minmax(int(spheres[slot]), int(spheres[lists[e * stride + slot]])));
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    const Plan* plan_;
    const ContactPlan* contact_;
    const Tables* tables_;
    // `spreads_`: the contacts of one sphere move others.
    bool spreads_ = false, self_ = false, walls_ = false, rigid_ = false;

  private:
    void respond(State& state, const Times& times) {
        if (contact_->remembers()) {
            prepare(state, times);
            for (int i = 0; i < contact_->settings.iterations; ++i)
                relax(state, times, i);
            settle(state, times);
        } else {
            runNearest(state, times);
        }
        apply(state, times);
        rest(state, times);
    }
};

}  // namespace shoal
