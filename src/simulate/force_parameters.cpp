#include "simulate/force_parameters.h"

#include <algorithm>
#include <cmath>

#include "compile/pack.h"
#include "core/contract.h"

namespace shoal {

namespace {

constexpr double nowhere = 1e18;  // m: a radius without end, whose square a float holds

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
            for (const GroupForces::One& one : *kind)
                write(one);
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

    // behind: its other parameters.
    void putPlace(const GroupForces::One& one, size_t behind, const glm::dvec3& own, double w) {
        SplitPoint place{glm::dvec3(0), placeOf(one.force, own)};
        if (isFar(plan_.forces[one.force])) {
            place = splitPoint(place.rest);
            put(one.slot + behind, place.lattice);
        }
        put(one.slot, place.rest, w);
    }

    static double reach(double radius) { return radius > 0 ? radius : nowhere; }

    // The slots of each kind, as its call names them (compile/generate_forces.cpp).
    void write(const GroupForces::One& one) {
        std::visit([&](const auto& kind) { write(one, kind, factorOf(one.force)); },
                   plan_.forces[one.force].shape);
    }

    void write(const GroupForces::One& one, const AttractForce& attract, double factor) {
        putPlace(one, 2, attract.position, factor * attract.strength);
        put(one.slot + 1, {reach(attract.radius), attract.most, 0});
    }

    void write(const GroupForces::One& one, const VortexLineForce& line, double factor) {
        putPlace(one, 3, line.position, factor * line.pull);
        put(one.slot + 1, glm::normalize(line.axis), factor * line.turn);
        put(one.slot + 2, {line.core, reach(line.radius), 0});
    }

    // All winds share one slot.
    void write(const GroupForces::One&, const WindForce& wind, double factor) {
        wind_ += factor * wind.velocity;
    }

    void write(const GroupForces::One& one, const ThrustForce& thrust, double factor) {
        constexpr double most = 40;  // e^40 takes what is too slow for a float's square to no speed at all
        const double rate = std::clamp(thrust.rate * factor, -1e3 / frame_.h, most / frame_.h);
        put(one.slot, {std::exp(rate * frame_.h), std::exp(rate * frame_.h / 2), thrust.limit}, rate);
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
