// Where the measured molecules of a scene ought to be at the end, in double precision.
#pragma once

#include <string>
#include <vector>

#include "compile/plan.h"
#include "reference/solve.h"
#include "simulate/simulation.h"

namespace shoal::measure {

// Distances from the reference over the molecule's size, as reference::deviation has them; RMS over the
// molecules of all groups. total^2 = centroid^2 + shape^2.
struct ErrorParts {
    double total = 0, centroid = 0, shape = 0;
    double worst = 0;  // total of the molecule that is farthest off
    size_t worstGroup = 0;
    int worstMolecule = 0;
};

// By how much the end differs from the reference's end, RMS over the molecules. With T and S the kinetic and
// the springs' energy, M the mass and L the size of a molecule:
//
//   energy            kinetic + springs + gravity, over  E = max(T + S at start and end, M g L)
//   momentum          length of the difference, over     P = sqrt(2 M E)
//   angular momentum  about its own centre of mass, over P L
struct Drift {
    double energy = 0, momentum = 0, angularMomentum = 0;
};

class ExactEnds {
  public:
    static constexpr double floor = 1e-7;  // no tolerance is tighter

    // `starts`: a snapshot of each group of the plan before its first frame. Borrows the scene. At most so
    // many molecules of each group, the first ones.
    ExactEnds(const Scene& scene, const Plan& plan, const std::vector<Snapshot>& starts, double duration,
              int cores, int molecules);
    ExactEnds(const ExactEnds&) = delete;
    ExactEnds& operator=(const ExactEnds&) = delete;

    // Estimated, with all cores.
    double secondsToSolve() const;
    // Solves all molecules to a tolerance, each in at most so many seconds, unless that has been done. False:
    // halving the step does not settle one of them; what was there before stays, and why() says which.
    bool solve(double tolerance, double secondsAMolecule = 10);
    const std::string& why() const { return why_; }
    double error() const { return error_; }  // of the last solution that settled: a bound

    static bool finite(const std::vector<Snapshot>& ends);
    ErrorParts errorOf(const std::vector<Snapshot>& ends) const;
    Drift driftOf(const std::vector<Snapshot>& ends) const;
    int molecules() const { return int(molecules_.size()); }

  private:
    struct One {
        size_t group = 0;
        int index = 0;  // in the group
        double size = 1;
        reference::Problem problem;
        reference::State start, end;
    };
    Drift driftOf(const One& one, const reference::State& end) const;

    std::vector<One> molecules_;
    double duration_;
    int cores_;
    double secondsPerStep_ = 0, tolerance_ = 1e30, error_ = 1e30;
    std::string why_;
    std::vector<std::string> names_;  // of the groups
};

}  // namespace shoal::measure
