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
        for (const GroupForces::One& one : group_.forces.pulls)
            writePull(one);
        for (const GroupForces::One& one : group_.forces.thrusts)
            writeThrust(one);
        glm::dvec3 wind(0);
        for (const GroupForces::One& one : group_.forces.winds)
            wind += factorOf(one.force) * std::get<WindForce>(plan_.forces[one.force].shape).velocity;
        if (!group_.forces.winds.empty()) put(group_.forces.windSlot, wind);
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

    void writePull(const GroupForces::One& one) {
        const ForceShape& shape = plan_.forces[one.force].shape;
        const double factor = factorOf(one.force);
        if (const auto* attract = std::get_if<AttractForce>(&shape)) {
            putPlace(one, 2, attract->position, factor * attract->strength);
            put(one.slot + 1, {reach(attract->radius), attract->most, 0});
        } else if (const auto* line = std::get_if<VortexLineForce>(&shape)) {
            putPlace(one, 3, line->position, factor * line->pull);
            put(one.slot + 1, glm::normalize(line->axis), factor * line->turn);
            put(one.slot + 2, {line->core, reach(line->radius), 0});
        }
    }

    void writeThrust(const GroupForces::One& one) {
        const auto& thrust = std::get<ThrustForce>(plan_.forces[one.force].shape);
        constexpr double most = 40;  // e^40 takes what is too slow for a float's square to no speed at all
        const double rate = std::clamp(thrust.rate * factorOf(one.force), -1e3 / frame_.h, most / frame_.h);
        put(one.slot, {std::exp(rate * frame_.h), std::exp(rate * frame_.h / 2), thrust.limit}, rate);
    }

    const Plan& plan_;
    const GroupPlan& group_;
    const Frame& frame_;
    std::vector<glm::vec4> out_;
    double middle_ = 0;  // s
};

}  // namespace

std::vector<glm::vec4> forceParameters(const Plan& plan, const GroupPlan& group, const Frame& frame) {
    return Writer(plan, group, frame).write();
}

}  // namespace shoal
