// The explicit methods of the GPU, step for step, in double precision: what the passes would compute if
// floats had no rounding. `euler` is symplectic Euler [Latta 2004, (3) and (8)], `leapfrog` its second-order
// relative. All but rk4 take gravity and drag exactly over the step they are given:
//   v += (u - v)(1 - exp(-gamma h)) + g (1 - exp(-gamma h)) / gamma,
// with the scene's forces in g. Thrust acts exactly, over h before a step of order 1, else over h/2 before
// and after it.
#pragma once

#include "reference/problem.h"

namespace shoal::reference {

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

// A frame of `substeps` equal steps of any solver, the implicit ones too (reference/implicit.h); leapfrog
// evaluates a anew at its start, and those with history start without.
void frame(const Problem& problem, State& state, SolverKind kind, double duration, int substeps);

}  // namespace shoal::reference
