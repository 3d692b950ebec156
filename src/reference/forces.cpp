#include "reference/forces.h"

#include <algorithm>
#include <cmath>

#include "reference/problem.h"

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

// Calls visit(force, what it is multiplied by and moved by now).
template <typename Visit>
void forEach(const std::vector<Force>& forces, double time, Visit visit) {
    for (const Force& force : forces)
        if (!force.mouse) visit(force, momentOf(force.path, time));
}

}  // namespace

std::vector<Force> forcesOn(const Scene& scene, const Group& group) {
    std::vector<Force> out;
    std::copy_if(scene.forces.begin(), scene.forces.end(), std::back_inserter(out),
                 [&](const Force& force) { return actsOn(force, group.name); });
    return out;
}

glm::dvec3 shapeAcceleration(const ForceShape& shape, const glm::dvec3& x) {
    return std::visit([&](const auto& force) { return acceleration(force, x); }, shape);
}

glm::dvec3 forceAcceleration(const std::vector<Force>& forces, const glm::dvec3& x, double time) {
    glm::dvec3 sum(0);
    forEach(forces, time, [&](const Force& force, const ForceMoment& now) {
        // the path changes the strength, not the bound `most`
        ForceShape shape = force.shape;
        if (auto* attract = std::get_if<AttractForce>(&shape)) attract->strength *= now.factor;
        if (auto* line = std::get_if<VortexLineForce>(&shape)) {
            line->pull *= now.factor;
            line->turn *= now.factor;
        }
        sum += shapeAcceleration(shape, x - now.offset);
    });
    return sum;
}

glm::dvec3 forceWind(const std::vector<Force>& forces, double time) {
    glm::dvec3 sum(0);
    forEach(forces, time, [&](const Force& force, const ForceMoment& now) {
        if (const auto* wind = std::get_if<WindForce>(&force.shape)) sum += now.factor * wind->velocity;
    });
    return sum;
}

glm::dvec3 thrustAcceleration(const std::vector<Force>& forces, const glm::dvec3& velocity, double time) {
    double rate = 0;
    forEach(forces, time, [&](const Force& force, const ForceMoment& now) {
        const auto* thrust = std::get_if<ThrustForce>(&force.shape);
        if (!thrust) return;
        const double own = thrust->rate * now.factor;
        if (own < 0 || glm::length(velocity) < thrust->limit) rate += own;
    });
    return rate * velocity;
}

glm::dvec3 thrusted(const std::vector<Force>& forces, glm::dvec3 velocity, double time, double duration) {
    forEach(forces, time, [&](const Force& force, const ForceMoment& now) {
        const auto* thrust = std::get_if<ThrustForce>(&force.shape);
        const double speed = glm::length(velocity);
        if (!thrust || speed == 0) return;
        const double rate = thrust->rate * now.factor, grown = speed * std::exp(rate * duration);
        if (rate < 0)
            velocity *= grown / speed;
        else if (speed < thrust->limit)
            velocity *= std::min(grown, thrust->limit) / speed;
    });
    return velocity;
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
