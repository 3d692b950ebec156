// The classical Runge-Kutta method of order 4 with its work arrays.
#pragma once

#include "reference/equations.h"

namespace shoal::reference {

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
