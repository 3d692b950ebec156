// The methods of the GPU, step for step, in double precision: what it would compute if floats had no
// rounding.
//
// The explicit ones (discrete.cpp): `euler` is symplectic Euler [Latta 2004, (3) and (8)], `leapfrog` its
// second-order relative. All but Runge-Kutta methods take gravity and drag exactly over the step they are
// given:
//   v += (u - v)(1 - exp(-gamma h)) + g (1 - exp(-gamma h)) / gamma,
// with the scene's forces in g. Thrust acts exactly, over h before a step of order 1, else over h/2 before
// and after it.
#pragma once

#include "reference/problem.h"

namespace shoal::reference {

// The rest shape, scaled, turned and moved to the instance, with velocity + spin x (x - placed origin) where
// free.
State restState(const Problem& problem, const Instance& instance = {}, const glm::dvec3& velocity = {},
                const glm::dvec3& spin = {});

// Spring forces divided by the mass, 0 at pinned vertices.
Vectors springAcceleration(const Problem& problem, const Vectors& position, const Vectors& velocity,
                           double time);
// Everything: springs, gravity, drag.
Vectors acceleration(const Problem& problem, const State& state);

// A mean velocity after `duration` (s) of thrust, exactly, with the factors of `time`.
glm::dvec3 thrusted(const std::vector<Force>& forces, glm::dvec3 velocity, double time, double duration);

// The thrust over h: what the mean velocity gains goes to all that is not pinned.
void push(const Problem& problem, State& state, double h);

// v += h F(x, v, t) / m;  exact drag and gravity with u(x, t) and the normal at x;  x += h v.
void eulerStep(const Problem& problem, State& state, double h);

// v1 = v + a h/2;  x1 = x + v1 h/2;  v2 = exact drag and gravity over h with u(x1, t + h/2) and the normal at
// x1; x' = x1 + v2 h/2;  a' = F(x', v2 + a h/2, t + h) / m;  v' = v2 + a' h/2. `springs` is a on entry and a'
// on return. Where both drag rates times h are beyond slipFrom, exp(-gamma h) becomes 1 / (1 + gamma h) and
// x' = x + v2 h (simulate/step.h says why).
void leapfrogStep(const Problem& problem, State& state, Vectors& springs, double h);

// As eulerStep, with every spring no stiffer than what moves its ends to its rest length at once, and v from
// the positions' difference.
void verletStep(const Problem& problem, State& state, double h);

// An explicit Runge-Kutta method from its tableau, with every stage kept. `smooth`: the problem without
// thrust.
void rungeKuttaStep(const Problem& problem, const Problem& smooth, const Tableau& tableau, State& state,
                    double h);

// The implicit ones (implicit.cpp) are written from the formulas, not from the shaders: dense matrices, a
// rotation by singular values.
//
// A stage over eta finds the displacements q of the step with
//   m (q - z) / eta = m w + eta (f(x + q, (q - z) / eta) + m g + m gamma (u - (q - z) / eta))
// from the solution without springs: by Gauss-Seidel sweeps over the springs as compliant constraints (XPBD,
// [Macklin 2016] and [Macklin 2019]), or by two quasi-Newton steps with the matrix of the rest shape, turned.

// q = h v after exact drag and gravity at x, t;  one sweep, in the order of compile/kernel.h;  v = q / h;  x
// += q.
void xpbdStep(const Problem& problem, State& state, double h);

// The changes of the last step; empty: none.
struct History {
    Vectors displacement, velocityChange;
};

// BDF2: z = dx / 3, w = v + dv / 3, eta = 2h/3; then v' = (q - z) / eta. Without history: exact for free
// flight in the fluid where the stage reads it, and the springs by backward Euler, eta = h. `kind`: one with
// history, which says how the stage is solved, guarded as the shader is.
void bdf2Step(const Problem& problem, State& state, History& history, double h, SolverKind kind);

// A frame of `substeps` equal steps of any solver; leapfrog evaluates a anew at its start, and those with
// history start without.
void frame(const Problem& problem, State& state, SolverKind kind, double duration, int substeps);

}  // namespace shoal::reference
