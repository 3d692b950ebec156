// The equations of a problem made ready for many evaluations: masses, rest lengths and factors are worked
// out once, and no evaluation allocates; and the method that evaluates them. The equations themselves:
// reference/problem.h.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/problem.h"

namespace shoal::reference {

class Equations {
  public:
    // Borrows the problem and its molecule.
    explicit Equations(const Problem& problem);

    const Problem& problem() const { return *problem_; }
    size_t vertices() const { return inverseMass_.size(); }
    bool pinned(size_t vertex) const { return inverseMass_[vertex] == 0; }

    // Each takes and fills one entry per vertex, in m, m/s and m/s^2. Velocities of pinned vertices must be
    // 0; their accelerations are.
    void springs(const Vectors& position, const Vectors& velocity, double time, Vectors& out);
    void everything(const Vectors& position, const Vectors& velocity, double time, Vectors& out);

  private:
    struct Muscle {
        size_t link;
        double restLength;        // m, relaxed
        double amplitude;         // share of it
        double angularFrequency;  // rad/s
        double phase;             // rad, the problem's included
    };

    void flex(double time);
    void addForces(const Vectors& position, const Vectors& velocity, double time, Vectors& out);
    void addDrag(const Vectors& position, const Vectors& velocity, double time, Vectors& out);

    const Problem* problem_;
    std::vector<double> inverseMass_;    // 1/kg, 0 where pinned
    std::vector<WeightedSpring> links_;  // with the problem's factors
    std::vector<Muscle> muscles_;
    Vectors normals_;
};

// The classical Runge-Kutta method of order 4 with its work arrays.
class RungeKutta {
  public:
    // Rates of change at (position, velocity, time): of the position in m/s, of the velocity in m/s^2.
    struct Rates {
        Vectors position, velocity;
    };

    explicit RungeKutta(size_t vertices) {
        for (Vectors* v :
             {&rate_.position, &rate_.velocity, &sum_.position, &sum_.velocity, &position_, &velocity_})
            v->resize(vertices);
    }

    // One step from `state` into `out` (another state, of as many vertices). `rates(x, v, t, out)` fills the
    // Rates of a stage. A rate of 0 leaves its value as it is, to the bit.
    template <typename Function>
    void step(const State& state, double h, Function&& rates, State& out) {
        rates(state.position, state.velocity, state.time, rate_);
        sum_.position = rate_.position;
        sum_.velocity = rate_.velocity;
        stage(state, h / 2, 2, rates);
        stage(state, h / 2, 2, rates);
        stage(state, h, 1, rates);
        out.time = state.time + h;
        advance(state.position, h / 6, sum_.position, out.position);
        advance(state.velocity, h / 6, sum_.velocity, out.velocity);
    }

  private:
    // Evaluates at `state` moved by h along the last stage's rates.
    template <typename Function>
    void stage(const State& state, double h, double weight, Function&& rates) {
        advance(state.position, h, rate_.position, position_);
        advance(state.velocity, h, rate_.velocity, velocity_);
        rates(position_, velocity_, state.time + h, rate_);
        advance(sum_.position, weight, rate_.position, sum_.position);
        advance(sum_.velocity, weight, rate_.velocity, sum_.velocity);
    }

    // out = x + h rate
    static void advance(const Vectors& x, double h, const Vectors& rate, Vectors& out) {
        for (size_t i = 0; i < x.size(); ++i)
            out[i] = x[i] + h * rate[i];
    }

    Rates rate_, sum_;
    Vectors position_, velocity_;  // of a stage
};

}  // namespace shoal::reference
