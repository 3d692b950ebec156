#include "reference/solve.h"

#include <algorithm>
#include <cmath>

#include "reference/contact.h"
#include "reference/equations.h"
#include "reference/forces.h"
#include "scene/field_kinds.h"

namespace shoal::reference {

namespace {

// Whether the springs' damping alone takes every oscillation of at least `rate` rad/s down by e^-20. A mode
// of frequency w decays at w^2 c / 2k when all springs have that c / k; the least c / k bounds it.
bool dampedAway(const Problem& problem, double rate, double duration) {
    double least = 1e30;  // s
    for (const WeightedSpring& spring : weightedSprings(*problem.molecule)) {
        if (spring.stiffness * problem.stiffness <= 0) continue;
        least = std::min(least, problem.damping * spring.damping / (problem.stiffness * spring.stiffness));
    }
    return least < 1e30 && rate * rate * least / 2 * duration > 20;
}

bool finite(const State& state) {
    return std::all_of(state.position.begin(), state.position.end(), [](const glm::dvec3& x) {
        return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    });
}

State integrateFreely(const Problem& problem, State state, double duration, int64_t steps,
                      Deadline& deadline) {
    Equations equations(problem);
    const auto rates = [&](const Vectors& x, const Vectors& v, double time, RungeKutta::Rates& out) {
        equations.everything(x, v, time, out.velocity);
        out.position = v;
    };
    RungeKutta method(equations.vertices());
    const double begin = state.time, h = duration / double(steps);
    State next = state;
    for (int64_t i = 0; i < steps; ++i) {
        deadline.check();
        method.step(state, h, rates, next);
        std::swap(state, next);
        state.time = begin + double(i + 1) * h;  // a sum of many steps would wander
    }
    return state;
}

// With whether contact has come to an end in every step. Equations and contact count on pinned vertices that
// stand still; what the start says of their velocity is kept for the caller.
ContactRun run(const Problem& problem, const State& start, double duration, int64_t steps,
               Deadline& deadline) {
    State still = start;
    for (size_t i = 0; i < still.velocity.size(); ++i) {
        if (problem.pinned(i)) still.velocity[i] = glm::dvec3(0);
    }
    ContactRun out = problem.colliders.empty()
                         ? ContactRun{integrateFreely(problem, std::move(still), duration, steps, deadline)}
                         : integrateWithContact(problem, still, duration, steps, deadline);
    for (size_t i = 0; i < start.velocity.size(); ++i) {
        if (problem.pinned(i)) out.state.velocity[i] = start.velocity[i];
    }
    return out;
}

}  // namespace

State integrate(const Problem& problem, const State& start, double duration, int64_t steps) {
    Deadline never;
    return run(problem, start, duration, steps, never).state;
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
    double driven = 0;
    for (const WeightedSpring& spring : weightedSprings(molecule)) {
        // Gershgorin: an eigenvalue of M^-1 K is at most the largest sum of a row's absolute values, here
        // halved
        double all = 0;
        for (const double weight : spring.weights)
            all += std::abs(weight);
        for (size_t i = 0; i < size_t(spring.count); ++i) {
            const size_t end = size_t(spring.vertices[i]);
            const double share = std::abs(spring.weights[i]) * all / 2;
            stiffness[end] += problem.stiffness * spring.stiffness * share;
            damping[end] += problem.damping * spring.damping * share;
        }
    }
    for (const Spring& spring : molecule.springs)
        if (spring.actuation) driven = std::max(driven, 6.3 * std::abs(spring.actuation->frequency));
    for (const Field& field : problem.fields) {
        if (const auto* wind = std::get_if<OscillatingField>(&*field.shape))
            driven = std::max(driven, 6.3 * wind->frequency);
    }
    for (const Force& force : problem.forces)
        driven = std::max(driven, shoal::fastestRate(force));
    double rate = std::max({driven, std::abs(problem.drag.normal), std::abs(problem.drag.tangent)});
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        if (problem.pinned(i)) continue;
        const double mass = molecule.vertices[i].mass;
        rate = std::max({rate, std::sqrt(2 * stiffness[i] / mass), 2 * damping[i] / mass});
    }
    return rate;
}

// Steps that resolve the fastest spring; four times longer ones where the springs' own damping leaves nothing
// of the motions that those would not resolve. (Motions that last must be resolved: two runs that both damp
// them away by their own error agree with each other.)
int64_t firstSteps(const Problem& problem, double duration) {
    const double rate = fastestRate(problem);
    const double perRadian = dampedAway(problem, rate / 2, duration) ? 0.5 : 2;
    // beyond 1e15 nobody waits for the end, and a whole number would overflow
    return int64_t(std::clamp(std::ceil(perRadian * duration * rate), 8.0, 1e15));
}

// Chaos: finer steps that have not brought their changes down go on not to.
static bool stalled(const std::vector<double>& changes) {
    constexpr size_t some = 5, many = 8;
    constexpr double large = 0.05;  // of the molecule's size
    const size_t count = changes.size();
    return (count > some && changes.back() > large) ||
           (count > many && changes.back() > changes[count - 1 - many] / 2);
}

namespace {

// Whether so many more halvings bring the change down to the tolerance if they go on as the last three did.
// True as well where these have not brought it down, which stalled() judges.
bool falls(const std::vector<double>& changes, double tolerance, double halvings) {
    constexpr size_t some = 3;
    if (changes.size() <= some) return true;
    const double last = changes.back(), before = changes[changes.size() - 1 - some];
    return last >= before || last * std::pow(last / before, halvings / some) <= tolerance;
}

class Halving {
  public:
    Halving(const Problem& problem, const State& start, double duration, double seconds)
        : problem_(problem), start_(start), duration_(duration), deadline_(seconds) {
        out_ = {start, duration, std::numeric_limits<double>::infinity(), false, Ended::outOfTime};
    }

    Solution solve(const std::function<double(const State&)>& tolerance, int halvings) {
        try {
            out_.ended = halve(tolerance, halvings);
        } catch (const OutOfTime&) {
            out_.ended = Ended::outOfTime;
        }
        out_.converged = out_.ended == Ended::converged;
        return std::move(out_);
    }

  private:
    Ended halve(const std::function<double(const State&)>& tolerance, int halvings) {
        const double size = problem_.size();
        int64_t steps = firstSteps(problem_, duration_);
        bool settledBefore = next(steps).settled;
        std::vector<double> changes;
        int unsettled = 0;  // runs in a row
        for (int i = 0; i < halvings; ++i) {
            if (stalled(changes)) return Ended::stalled;
            if (unsettled >= 5) return Ended::unsettled;
            // n halvings take 2 + 4 + ... + 2^n times as long as the last run
            const double more = std::floor(std::log2(deadline_.left() / secondsOfRun_ / 2 + 1));
            if (more < 1 || !falls(changes, tolerance(out_.state), more)) return Ended::outOfTime;
            const State coarse = out_.state;
            const ContactRun finer = next(steps *= 2);
            if (!finite(finer.state)) return Ended::notFinite;
            out_.error = relativeError(out_.state, coarse, size);
            if (settledBefore && finer.settled && out_.error <= tolerance(out_.state))
                return Ended::converged;
            settledBefore = finer.settled;
            unsettled = finer.settled ? 0 : unsettled + 1;
            changes.push_back(out_.error);
        }
        if (unsettled > 0) return Ended::unsettled;
        return stalled(changes) ? Ended::stalled : Ended::outOfHalvings;
    }

    ContactRun next(int64_t steps) {
        const double before = deadline_.passed();
        ContactRun attempt = run(problem_, start_, duration_, steps, deadline_);
        secondsOfRun_ = deadline_.passed() - before;
        if (steps == firstSteps(problem_, duration_) || finite(attempt.state)) {
            out_.state = attempt.state;
            out_.step = duration_ / double(steps);
        }
        return attempt;
    }

    const Problem& problem_;
    const State& start_;
    double duration_;
    Deadline deadline_;
    double secondsOfRun_ = 0;
    Solution out_;
};

}  // namespace

Solution solve(const Problem& problem, const State& start, double duration, double tolerance, int halvings,
               double seconds) {
    return solve(
        problem, start, duration, [&](const State&) { return tolerance; }, halvings, seconds);
}

Solution solve(const Problem& problem, const State& start, double duration,
               const std::function<double(const State&)>& tolerance, int halvings, double seconds) {
    return Halving(problem, start, duration, seconds).solve(tolerance, halvings);
}

}  // namespace shoal::reference
