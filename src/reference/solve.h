// The solution of a problem to a stated error: classical Runge-Kutta of order 4 whose fixed step is halved
// until the answer stops changing. Contact: reference/contact.h.
#pragma once

#include <functional>
#include <limits>

#include "reference/problem.h"

namespace shoal::reference {

// `steps` equal steps over `duration`, with contact where the problem has colliders.
State integrate(const Problem& problem, const State& start, double duration, int64_t steps);

// A distance between two states, RMS over the vertices and divided by `size`, with the parts that make it up:
// total^2 = centroid^2 + shape^2 (centroid: mean of the vertices; shape: turning and deformation).
struct Deviation {
    double total = 0, centroid = 0, shape = 0;
};
Deviation deviation(const State& state, const State& reference, double size);
double relativeError(const State& state, const State& reference, double size);

enum class Ended {
    converged,
    outOfTime,
    outOfHalvings,
    stalled,    // the motion is chaotic or not smooth
    unsettled,  // its contacts do not come to an end
    notFinite,
};

struct Solution {
    State state;       // after `duration`
    double step = 0;   // s, the last and smallest
    double error = 0;  // relative: the change at the last halving, which bounds the error of what is returned
    bool converged = true;
    Ended ended = Ended::converged;  // why halving ended
};

// Halves until the change is below tolerance (relative to the scaled molecule's size), at most `halvings`
// times from a step that resolves the fastest spring that lasts and for at most `seconds` on the clock; gives
// up earlier where six halvings leave a change of 5 %, or eight in a row have not even halved it: the motion
// is chaotic. A converging RK4 is 16 times better than its last change. The state is finite if the start is
// and any of the steps was stable.
//
// An error that is infinite is not known: nothing has been halved. Where not even the first run has come to
// its end, the state is the start.
Solution solve(const Problem& problem, const State& start, double duration, double tolerance,
               int halvings = 12, double seconds = std::numeric_limits<double>::infinity());
// Likewise, with a tolerance that depends on the solution so far.
Solution solve(const Problem& problem, const State& start, double duration,
               const std::function<double(const State&)>& tolerance, int halvings, double seconds);

// How many steps the first run takes.
int64_t firstSteps(const Problem& problem, double duration);

// An upper bound of the rates in 1/s at which anything in the problem oscillates or decays.
double fastestRate(const Problem& problem);

}  // namespace shoal::reference
