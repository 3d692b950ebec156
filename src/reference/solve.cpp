#include "reference/solve.h"

#include <algorithm>
#include <cmath>

namespace shoal::reference {

namespace {

State advanced(const Problem& problem, const State& state, const Vectors& velocity, const Vectors& change,
               double h) {
    State out = state;
    out.time += h;
    for (size_t i = 0; i < out.position.size(); ++i) {
        if (problem.pinned(i)) continue;
        out.position[i] += h * velocity[i];
        out.velocity[i] += h * change[i];
    }
    return out;
}

bool finite(const State& state) {
    return std::all_of(state.position.begin(), state.position.end(), [](const glm::dvec3& x) {
        return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    });
}

}  // namespace

void rungeKuttaStep(const Problem& problem, State& state, double h) {
    const Vectors a1 = acceleration(problem, state);
    const State s2 = advanced(problem, state, state.velocity, a1, h / 2);
    const Vectors a2 = acceleration(problem, s2);
    const State s3 = advanced(problem, state, s2.velocity, a2, h / 2);
    const Vectors a3 = acceleration(problem, s3);
    const State s4 = advanced(problem, state, s3.velocity, a3, h);
    const Vectors a4 = acceleration(problem, s4);
    for (size_t i = 0; i < state.position.size(); ++i) {
        if (problem.pinned(i)) continue;
        state.position[i] +=
            h / 6 * (state.velocity[i] + 2.0 * s2.velocity[i] + 2.0 * s3.velocity[i] + s4.velocity[i]);
        state.velocity[i] += h / 6 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
    }
    state.time += h;
}

State integrate(const Problem& problem, const State& start, double duration, int64_t steps) {
    State state = start;
    const double h = duration / double(steps);
    for (int64_t i = 0; i < steps; ++i) {
        rungeKuttaStep(problem, state, h);
        state.time = start.time + double(i + 1) * h;  // a sum of many steps would wander
    }
    return state;
}

Deviation deviation(const State& state, const State& reference, double size) {
    const double count = double(state.position.size());
    glm::dvec3 mean(0);
    double square = 0;
    for (size_t i = 0; i < state.position.size(); ++i) {
        const glm::dvec3 d = state.position[i] - reference.position[i];
        mean += d / count;
        square += glm::dot(d, d) / count;
    }
    double shape = 0;
    for (size_t i = 0; i < state.position.size(); ++i) {
        const glm::dvec3 d = state.position[i] - reference.position[i] - mean;
        shape += glm::dot(d, d) / count;
    }
    return {std::sqrt(square) / size, glm::length(mean) / size, std::sqrt(shape) / size};
}

double relativeError(const State& state, const State& reference, double size) {
    return deviation(state, reference, size).total;
}

double fastestRate(const Problem& problem) {
    const Molecule& molecule = *problem.molecule;
    std::vector<double> stiffness(molecule.vertices.size()), damping(molecule.vertices.size());
    double muscle = 0;
    for (const Spring& spring : molecule.springs) {
        for (int end : {spring.a, spring.b}) {
            stiffness[size_t(end)] += problem.stiffness * spring.stiffness;
            damping[size_t(end)] += problem.damping * spring.damping;
        }
        if (spring.actuation) muscle = std::max(muscle, 6.3 * std::abs(spring.actuation->frequency));
    }
    // Gershgorin: an eigenvalue of M^-1 K is at most twice the largest sum of k / m around a vertex
    double rate = std::max({muscle, std::abs(problem.drag.normal), std::abs(problem.drag.tangent)});
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        if (problem.pinned(i)) continue;
        const double mass = molecule.vertices[i].mass;
        rate = std::max({rate, std::sqrt(2 * stiffness[i] / mass), 2 * damping[i] / mass});
    }
    return rate;
}

Solution solve(const Problem& problem, const State& start, double duration, double tolerance, int halvings) {
    const double size = problem.scale * problem.molecule->size();
    int64_t steps = std::max<int64_t>(8, int64_t(std::ceil(2 * duration * fastestRate(problem))));
    Solution out{integrate(problem, start, duration, steps), duration / double(steps), 0, false};
    for (int i = 0; i < halvings && !out.converged; ++i) {
        steps *= 2;
        State finer = integrate(problem, start, duration, steps);
        out.error = relativeError(finer, out.state, size);
        out.step = duration / double(steps);
        out.state = std::move(finer);
        out.converged = finite(out.state) && out.error <= tolerance;
    }
    return out;
}

}  // namespace shoal::reference
