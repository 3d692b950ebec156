// Where the measured molecules of a scene ought to be at the end, in double precision.
#pragma once

#include <optional>
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

enum class Settled {
    yes,
    roughly,   // time ran out, or halvings, with a small change left: error() is above the tolerance
    chaotic,   // halving the step stalls, or leaves a change of some per cent
    tooStiff,  // time ran out while halving the step still changed it by some per cent, or was not done once
};

class ExactEnds {
  public:
    static constexpr double floor = 1e-7;       // no tolerance is tighter
    static constexpr double mostChange = 0.03;  // that is uncertain only
    static constexpr double usualSeconds = 10;  // of a molecule

    // `starts`: a snapshot of each group of the plan before its first frame. Borrows the scene. At most so
    // many molecules of each group, the first ones.
    ExactEnds(const Scene& scene, const Plan& plan, const std::vector<Snapshot>& starts, double duration,
              int cores, int molecules);
    // Likewise, of these: group and number in it.
    ExactEnds(const Scene& scene, const Plan& plan, const std::vector<Snapshot>& starts, double duration,
              int cores, const std::vector<std::pair<size_t, int>>& which);
    ExactEnds(const ExactEnds&) = delete;
    ExactEnds& operator=(const ExactEnds&) = delete;

    // Estimated, with all cores, each molecule in at most so many seconds.
    double secondsToSolve(double secondsAMolecule = usualSeconds) const;
    // Solves all molecules to a tolerance, each in at most so many seconds, unless that has been done. The
    // worst molecule decides the result, and why() names it. Where that is chaotic or too stiff, the earlier
    // solution stays; where it is solved roughly, the more accurate of the two.
    Settled solve(double tolerance, double secondsAMolecule = usualSeconds);
    // How long each molecule may take if all together may take so many seconds.
    double secondsEach(double seconds, double most = usualSeconds) const;
    const std::string& why() const { return why_; }
    double error() const { return error_; }  // of what is there: a bound

    static bool finite(const std::vector<Snapshot>& ends);
    ErrorParts errorOf(const std::vector<Snapshot>& ends) const;
    Drift driftOf(const std::vector<Snapshot>& ends) const;
    int molecules() const { return int(molecules_.size()); }
    // Returns the relative error of each molecule; placeOf() says where among them one is.
    std::vector<double> eachOf(const std::vector<Snapshot>& ends) const;
    std::optional<size_t> placeOf(size_t group, int molecule) const;
    static reference::State stateOf(const Snapshot& snapshot, int molecule);

  private:
    struct ExactMolecule {
        size_t group = 0;
        int index = 0;  // in the group
        double size = 1;
        reference::Problem problem;
        reference::State start, end;
    };
    Drift driftOf(const ExactMolecule& molecule, const reference::State& end) const;
    double secondsOf(const ExactMolecule& molecule, double most) const;
    bool tooStiff(const ExactMolecule& molecule, double seconds);
    Settled judge(const ExactMolecule& molecule, const reference::Solution& solution, double seconds);
    void keep(std::vector<reference::Solution>& solutions);
    std::string nameOf(const ExactMolecule& molecule) const;

    std::vector<ExactMolecule> molecules_;
    double duration_;
    int cores_;
    double secondsPerStep_ = 0, tolerance_ = 1e30, error_ = 1e30;
    std::string why_;
    std::vector<std::string> names_;  // of the groups
};

}  // namespace shoal::measure
