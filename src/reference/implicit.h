// The implicit methods of the GPU, step for step, in double precision: what the fused step would compute if
// floats had no rounding. Written from the formulas, not from the shaders: dense matrices, a rotation by
// singular values.
//
// A stage over eta finds the displacements q of the step with
//   m (q - z) / eta = m w + eta (f(x + q, (q - z) / eta) + m g + m gamma (u - (q - z) / eta))
// from the solution without springs: by Gauss-Seidel sweeps over the springs as compliant constraints (XPBD,
// [Macklin 2016] and [Macklin 2019]), or by two quasi-Newton steps with the matrix of the rest shape, turned.
#pragma once

#include "reference/problem.h"

namespace shoal::reference {

// q = h v after exact drag and gravity at x, t;  one sweep, in the order of compile/kernel.h;  v = q / h;  x
// += q.
void xpbdStep(const Problem& problem, State& state, double h);

// The changes of the last step; empty: none.
struct History {
    Vectors displacement, velocityChange;
};

// BDF2: z = dx / 3, w = v + dv / 3, eta = 2h/3; then v' = (q - z) / eta. Without history: exact for free
// flight in the fluid where the stage reads it, and the springs by backward Euler, eta = h. `corotated`:
// quasi-Newton steps, guarded as the shader is; else two sweeps, there and back.
void bdf2Step(const Problem& problem, State& state, History& history, double h, bool corotated);

}  // namespace shoal::reference
