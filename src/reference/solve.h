// The solution of a problem to a stated error: classical Runge-Kutta of order 4 whose fixed step is halved
// until the answer stops changing. Contact: reference/contact.h.
#pragma once

#include "reference/problem.h"

namespace shoal::reference {

// One classical step: RK4. Without contact.
void rungeKuttaStep(const Problem& problem, State& state, double h);

// `steps` equal steps over `duration`, with contact where the problem has colliders.
State integrate(const Problem& problem, const State& start, double duration, int64_t steps);

// A distance between two states, RMS over the vertices and divided by `size`, with the parts that make it up:
// total^2 = centroid^2 + shape^2 (centroid: mean of the vertices; shape: turning and deformation).
struct Deviation {
    double total = 0, centroid = 0, shape = 0;
};
Deviation deviation(const State& state, const State& reference, double size);
double relativeError(const State& state, const State& reference, double size);

struct Solution {
    State state;       // after `duration`
    double step = 0;   // s, the last and smallest
    double error = 0;  // relative: the change at the last halving, which bounds the error of what is returned
    // False: halving does not settle it. The motion is chaotic or not smooth, or its contacts do not come to
    // an end.
    bool converged = true;
};

// Halves until the change is below tolerance (relative to the scaled molecule's size), at most `halvings`
// times from a step that resolves the fastest spring that lasts; gives up earlier where six halvings leave a
// change of 5 %, or eight in a row have not even halved it: the motion is chaotic. A converging RK4 is 16
// times better than its last change. The state is finite if the start is and any of the steps was stable.
Solution solve(const Problem& problem, const State& start, double duration, double tolerance,
               int halvings = 12);

// An upper bound of the rates in 1/s at which anything in the problem oscillates or decays.
double fastestRate(const Problem& problem);

}  // namespace shoal::reference
