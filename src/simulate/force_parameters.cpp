#include "simulate/step.h"

#include <algorithm>
#include <cmath>

#include "compile/call_writer.h"
#include "compile/pack.h"
#include "core/contract.h"
#include "scene/force_kinds.h"

namespace shoal {

namespace {

class Writer {
  public:
    Writer(const Plan& plan, const GroupPlan& group, const Frame& frame)
        : plan_(plan), group_(group), frame_(frame), out_(group.forces.parameterCount) {
        middle_ = frame.time + 0.5 * frame.parameters.frameTime;
        if (solver(group.solver).history) middle_ += 0.5 * frame.h;
    }

    std::vector<glm::vec4> write() {
        EXPECTS(frame_.parameters.forces.size() == plan_.forces.size());
        for (const auto* kind : {&group_.forces.pulls, &group_.forces.thrusts, &group_.forces.winds})
            for (const GroupForces::Entry& entry : *kind)
                write(entry);
        if (!group_.forces.winds.empty()) put(group_.forces.windSlot, wind_);
        return std::move(out_);
    }

  private:
    void put(size_t slot, const glm::dvec3& v, double w = 0) { out_[slot] = glm::vec4(glm::dvec4(v, w)); }

    double factorOf(size_t force) const {
        const ForceControl& control = frame_.parameters.forces[force];
        return control.on ? control.factor * momentOf(plan_.forces[force].path, middle_).factor : 0;
    }

    glm::dvec3 placeOf(size_t force, const glm::dvec3& own) const {
        const ForceControl& control = frame_.parameters.forces[force];
        return control.position.value_or(own + momentOf(plan_.forces[force].path, middle_).offset);
    }

    void write(const GroupForces::Entry& entry) {
        std::visit([&](const auto& kind) { write(entry, kind.times(factorOf(entry.force))); },
                   *plan_.forces[entry.force].shape);
    }

    // The slots as the text of the call names them (compile/generate_forces.cpp).
    template <typename Pull>
    void write(const GroupForces::Entry& entry, Pull pull) {
        pull.position = placeOf(entry.force, pull.position);
        const std::vector<glm::vec4> own = parametersOf(pull.call(), isFar(plan_.forces[entry.force]));
        std::copy(own.begin(), own.end(), out_.begin() + ptrdiff_t(entry.slot));
    }

    // All winds share one slot.
    void write(const GroupForces::Entry&, const WindForce& wind) { wind_ += wind.velocity; }

    void write(const GroupForces::Entry& entry, const ThrustForce& thrust) {
        constexpr double most = 40;  // e^40 takes what is too slow for a float's square to no speed at all
        const double rate = std::clamp(thrust.rate, -1e3 / frame_.h, most / frame_.h);
        put(entry.slot, {std::exp(rate * frame_.h), std::exp(rate * frame_.h / 2), thrust.limit}, rate);
    }

    const Plan& plan_;
    const GroupPlan& group_;
    const Frame& frame_;
    std::vector<glm::vec4> out_;
    double middle_ = 0;   // s
    glm::dvec3 wind_{0};  // m/s, the sum
};

}  // namespace

std::vector<glm::vec4> forceParameters(const Plan& plan, const GroupPlan& group, const Frame& frame) {
    return Writer(plan, group, frame).write();
}

}  // namespace shoal
