#include "reference/forces.h"

#include <algorithm>
#include <cmath>

#include "reference/problem.h"
#include "scene/force_kinds.h"

namespace shoal::reference {

namespace {

glm::dvec3 acceleration(const AttractForce& force, const glm::dvec3& x) {
    const glm::dvec3 d = force.position - x;
    const double distance = glm::length(d);
    if (distance == 0 || (force.radius > 0 && distance > force.radius)) return glm::dvec3(0);
    if (force.falloff == AttractForce::Falloff::constant) return d / distance * force.strength;
    const double pull = std::min(std::abs(force.strength) / (distance * distance), force.most);
    return d / distance * std::copysign(pull, force.strength);
}

glm::dvec3 acceleration(const VortexLineForce& force, const glm::dvec3& x) {
    const glm::dvec3 axis = glm::normalize(force.axis), d = x - force.position;
    const glm::dvec3 out = d - glm::dot(d, axis) * axis;  // from the line
    const double distance = glm::length(out);
    if (distance == 0 || (force.radius > 0 && distance > force.radius)) return glm::dvec3(0);
    const double share = distance <= force.core ? distance / force.core : force.core / distance;
    return share * (force.turn * glm::cross(axis, out / distance) - force.pull * out / distance);
}

glm::dvec3 acceleration(const ThrustForce&, const glm::dvec3&) {
    return glm::dvec3(0);
}

glm::dvec3 acceleration(const WindForce&, const glm::dvec3&) {
    return glm::dvec3(0);
}

// Calls visit(kind with its strength of now, how far it has moved, m).
template <typename Visit>
void forEach(const std::vector<Force>& forces, double time, Visit visit) {
    for (const Force& force : forces) {
        if (force.mouse) continue;
        const ForceMoment moment = momentOf(force.path, time);
        std::visit([&](const auto& kind) { visit(kind.times(moment.factor), moment.offset); }, *force.shape);
    }
}

}  // namespace

std::vector<Force> forcesOn(const Scene& scene, const Group& group) {
    std::vector<Force> out;
    std::copy_if(scene.forces.begin(), scene.forces.end(), std::back_inserter(out),
                 [&](const Force& force) { return actsOn(force, group.name); });
    return out;
}

glm::dvec3 forceAcceleration(const std::vector<Force>& forces, const glm::dvec3& x, double time) {
    glm::dvec3 sum(0);
    forEach(forces, time,
            [&](const auto& force, const glm::dvec3& offset) { sum += acceleration(force, x - offset); });
    return sum;
}

glm::dvec3 forceWind(const std::vector<Force>& forces, double time) {
    glm::dvec3 sum(0);
    forEach(forces, time, [&]<typename Kind>(const Kind& force, const glm::dvec3&) {
        if constexpr (std::is_same_v<Kind, WindForce>) sum += force.velocity;
    });
    return sum;
}

glm::dvec3 thrustAcceleration(const std::vector<Force>& forces, const glm::dvec3& velocity, double time) {
    double rate = 0;
    forEach(forces, time, [&]<typename Kind>(const Kind& force, const glm::dvec3&) {
        if constexpr (std::is_same_v<Kind, ThrustForce>)
            if (force.rate < 0 || glm::length(velocity) < force.limit) rate += force.rate;
    });
    return rate * velocity;
}

glm::dvec3 meanVelocity(const Problem& problem, const std::vector<glm::dvec3>& velocity) {
    glm::dvec3 momentum(0);
    double mass = 0;
    for (size_t i = 0; i < velocity.size(); ++i) {
        const double own = problem.molecule->vertices[i].mass;
        mass += own;
        if (!problem.pinned(i)) momentum += own * velocity[i];
    }
    return momentum / mass;
}

}  // namespace shoal::reference
