#include "reference/discrete.h"

#include <cmath>

#include "core/error.h"
#include "molecule/skin.h"
#include "reference/equations.h"
#include "reference/fields.h"
#include "reference/forces.h"
#include "scene/force_kinds.h"

namespace shoal::reference {

namespace {

// The linear part, dv/dt = g + gamma (u - v), solved over h along one direction or all.
glm::dvec3 relaxed(const glm::dvec3& v, const glm::dvec3& u, const glm::dvec3& gravity, double rate, double h,
                   bool slips) {
    if (rate == 0) return v + h * gravity;
    const double decay = slips ? rate * h / (1 + rate * h) : -std::expm1(-rate * h);
    return v + decay * (u - v) + decay / rate * gravity;
}

// As relaxed(), with one rate along the unit normal n and another across it.
glm::dvec3 linearPart(const Problem& problem, const glm::dvec3& v, const glm::dvec3& u, const glm::dvec3& a,
                      const glm::dvec3& n, double h, bool slips) {
    const glm::dvec3 plain = relaxed(v, u, a, problem.drag.tangent, h, slips);
    if (!problem.drag.directional()) return plain;
    const glm::dvec3 across = relaxed(v, u, a, problem.drag.normal, h, slips);
    return plain + glm::dot(across - plain, n) * n;
}

void applyLinearPart(const Problem& problem, Vectors& velocity, const Vectors& position, double time,
                     double h, bool slips = false) {
    Vectors normal(position.size(), glm::dvec3(0));
    if (problem.drag.directional()) normal = vertexNormals(*problem.molecule, position);
    for (size_t i = 0; i < position.size(); ++i) {
        if (problem.pinned(i)) continue;
        glm::dvec3 u(0);
        if (problem.drag.any())
            u = forceWind(problem.forces, time) + fluidVelocity(problem.fields, position[i], time);
        const glm::dvec3 a = problem.gravity + forceAcceleration(problem.forces, position[i], time);
        velocity[i] = linearPart(problem, velocity[i], u, a, normal[i], h, slips);
    }
}

void add(const Problem& problem, Vectors& to, const Vectors& rate, double h) {
    for (size_t i = 0; i < to.size(); ++i) {
        if (!problem.pinned(i)) to[i] += h * rate[i];
    }
}

Vectors freeVelocities(const Problem& problem, const Vectors& velocity) {
    Vectors out(velocity.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = problem.pinned(i) ? glm::dvec3(0) : velocity[i];
    return out;
}

}  // namespace

State restState(const Problem& problem, const Instance& instance, const glm::dvec3& velocity,
                const glm::dvec3& spin) {
    State state;
    for (size_t i = 0; i < problem.molecule->vertices.size(); ++i) {
        const glm::dvec3 arm = instance.rotation * (instance.scale * problem.molecule->vertices[i].position);
        state.position.push_back(instance.position + arm);
        state.velocity.push_back(problem.pinned(i) ? glm::dvec3(0) : velocity + glm::cross(spin, arm));
    }
    return state;
}

Vectors springAcceleration(const Problem& problem, const Vectors& position, const Vectors& velocity,
                           double time) {
    Vectors out;
    Equations(problem).springs(position, freeVelocities(problem, velocity), time, out);
    return out;
}

Vectors acceleration(const Problem& problem, const State& state) {
    Vectors out;
    Equations(problem).everything(state.position, freeVelocities(problem, state.velocity), state.time, out);
    return out;
}

glm::dvec3 thrusted(const std::vector<Force>& forces, glm::dvec3 velocity, double time, double duration) {
    for (const Force& force : forces) {
        const auto* kind = std::get_if<ThrustForce>(&*force.shape);
        if (!kind || force.mouse) continue;
        const ThrustForce thrust = kind->times(momentOf(force.path, time).factor);
        const double speed = glm::length(velocity), grown = speed * std::exp(thrust.rate * duration);
        if (speed == 0) continue;
        if (thrust.rate < 0)
            velocity *= grown / speed;
        else if (speed < thrust.limit)
            velocity *= std::min(grown, thrust.limit) / speed;
    }
    return velocity;
}

void push(const Problem& problem, State& state, double h) {
    const glm::dvec3 mean = meanVelocity(problem, state.velocity);
    const glm::dvec3 gained = thrusted(problem.forces, mean, state.time, h) - mean;
    for (size_t i = 0; i < state.velocity.size(); ++i)
        if (!problem.pinned(i)) state.velocity[i] += gained;
}

void eulerStep(const Problem& problem, State& state, double h) {
    push(problem, state, h);
    add(problem, state.velocity, springAcceleration(problem, state.position, state.velocity, state.time), h);
    applyLinearPart(problem, state.velocity, state.position, state.time, h);
    add(problem, state.position, state.velocity, h);
    state.time += h;
}

void verletStep(const Problem& problem, State& state, double h) {
    const auto bound = [&](Molecule molecule) {
        for (Spring& spring : molecule.springs) {
            const double weight =
                1 / molecule.vertices[size_t(spring.a)].mass + 1 / molecule.vertices[size_t(spring.b)].mass;
            spring.restLength = problem.molecule->restLength(spring);
            spring.stiffness = std::min(spring.stiffness, 1 / (weight * h * h * problem.stiffness));
        }
        return molecule;
    };
    const Molecule molecule = bound(*problem.molecule);
    Problem bounded = problem;
    bounded.molecule = &molecule;
    eulerStep(bounded, state, h);
}

void leapfrogStep(const Problem& problem, State& state, Vectors& springs, double h) {
    const bool slips = std::min(problem.drag.normal, problem.drag.tangent) * h > slipFrom;
    push(problem, state, h / 2);
    add(problem, state.velocity, springs, h / 2);
    const Vectors start = state.position;
    add(problem, state.position, state.velocity, h / 2);
    applyLinearPart(problem, state.velocity, state.position, state.time + h / 2, h, slips);
    if (slips) state.position = start;
    add(problem, state.position, state.velocity, slips ? h : h / 2);
    state.time += h;
    Vectors predicted = state.velocity;
    add(problem, predicted, springs, h / 2);
    springs = springAcceleration(problem, state.position, predicted, state.time);
    add(problem, state.velocity, springs, h / 2);
    push(problem, state, h / 2);
}

void rungeKuttaStep(const Problem& problem, const Problem& smooth, const Tableau& tableau, State& state,
                    double h) {
    push(problem, state, h / 2);
    const State start = state;
    std::vector<Vectors> velocities, accelerations;  // of each stage
    for (int s = 0; s <= tableau.stages; ++s) {
        const double* share = s < tableau.stages ? tableau.a[s] : tableau.b;
        state = start;
        for (int j = 0; j < s; ++j) {
            add(problem, state.position, velocities[size_t(j)], h * share[j]);
            add(problem, state.velocity, accelerations[size_t(j)], h * share[j]);
        }
        state.time = start.time + h * (s < tableau.stages ? tableau.time(s) : 1);
        velocities.push_back(freeVelocities(problem, state.velocity));
        accelerations.push_back(acceleration(smooth, state));
    }
    push(problem, state, h / 2);
}

void frame(const Problem& problem, State& state, SolverKind kind, double duration, int substeps) {
    const double h = duration / substeps;
    const Solver& method = solver(kind);
    Vectors springs;
    if (kind == SolverKind::leapfrog)
        springs = springAcceleration(problem, state.position, state.velocity, state.time);
    Problem smooth = problem;  // without thrust and contact
    smooth.colliders.clear();
    std::erase_if(smooth.forces,
                  [](const Force& force) { return std::holds_alternative<ThrustForce>(*force.shape); });
    History history;
    for (int i = 0; i < substeps; ++i) {
        if (method.rungeKutta())
            rungeKuttaStep(problem, smooth, method.tableau, state, h);
        else if (method.history)
            bdf2Step(problem, state, history, h, kind);
        else if (kind == SolverKind::euler)
            eulerStep(problem, state, h);
        else if (kind == SolverKind::verlet)
            verletStep(problem, state, h);
        else if (kind == SolverKind::leapfrog)
            leapfrogStep(problem, state, springs, h);
        else if (kind == SolverKind::xpbd)
            xpbdStep(problem, state, h);
        else
            throw Error(method.name, " has no recurrence in double precision");
    }
}

}  // namespace shoal::reference
