#include "reference/problem.h"

#include <cmath>
#include <numbers>

namespace shoal::reference {

namespace {

glm::dvec3 freeVelocity(const Problem& problem, const Vectors& velocity, size_t vertex) {
    return problem.pinned(vertex) ? glm::dvec3(0) : velocity[vertex];
}

}  // namespace

double restLength(const Problem& problem, const Spring& spring, double time) {
    double length = problem.scale * problem.molecule->restLength(spring);
    if (const auto& muscle = spring.actuation) {
        const double turns = 2 * std::numbers::pi * muscle->frequency * time;
        length *= 1 + muscle->amplitude * std::sin(turns + muscle->phase + problem.phase);
    }
    return length;
}

double kineticEnergy(const Problem& problem, const State& state) {
    double sum = 0;
    for (size_t i = 0; i < state.velocity.size(); ++i) {
        const glm::dvec3 v = freeVelocity(problem, state.velocity, i);
        sum += 0.5 * problem.molecule->vertices[i].mass * glm::dot(v, v);
    }
    return sum;
}

double springEnergy(const Problem& problem, const State& state) {
    double sum = 0;
    for (const Spring& spring : problem.molecule->springs) {
        const double stretch =
            glm::length(state.position[size_t(spring.a)] - state.position[size_t(spring.b)]) -
            restLength(problem, spring, state.time);
        sum += 0.5 * problem.stiffness * spring.stiffness * stretch * stretch;
    }
    for (const Bend& bend : problem.molecule->bends) {
        const WeightedSpring spring = weighted(*problem.molecule, bend);
        const double stretch = glm::length(spring.along(state.position)) - problem.scale * spring.restLength;
        sum += 0.5 * problem.stiffness * spring.stiffness * stretch * stretch;
    }
    return sum;
}

double energy(const Problem& problem, const State& state) {
    double height = 0;
    for (size_t i = 0; i < state.position.size(); ++i) {
        if (problem.pinned(i)) continue;
        height -= problem.molecule->vertices[i].mass * glm::dot(problem.gravity, state.position[i]);
    }
    return kineticEnergy(problem, state) + springEnergy(problem, state) + height;
}

glm::dvec3 momentum(const Problem& problem, const State& state) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < state.velocity.size(); ++i) {
        sum += problem.molecule->vertices[i].mass * freeVelocity(problem, state.velocity, i);
    }
    return sum;
}

glm::dvec3 angularMomentum(const Problem& problem, const State& state) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < state.velocity.size(); ++i) {
        sum += problem.molecule->vertices[i].mass *
               glm::cross(state.position[i], freeVelocity(problem, state.velocity, i));
    }
    return sum;
}

}  // namespace shoal::reference
