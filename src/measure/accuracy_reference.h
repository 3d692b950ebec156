// Where the measured molecules of a scene ought to be at the end, in double precision.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "core/error.h"
#include "measure/timing.h"
#include "reference/solve.h"
#include "simulate/simulation.h"

namespace shoal::measure {

// A molecule of the group, of this scale and with this phase of its muscles (rad), with gravity and its
// springs alone: what its energy takes. Borrows the group's molecule.
reference::Problem springsOf(const Scene& scene, const Group& group, double scale, double phase);
// Why the reference does not know how a molecule of the group moves by itself, located; nothing: it does.
std::optional<Warning> whyNoReference(const Scene& scene, const Group& group);
// Error: whyNoReference, of the first group that has none; or the scene has no groups.
void requireReference(const Scene& scene);
// The molecule with all that acts on it. The group is one of which whyNoReference says nothing.
reference::Problem problemOf(const Scene& scene, const Group& group, double scale, double phase);
// s of the clock that one step of its first run takes, from the start on.
double secondsOfStep(const reference::Problem& problem, const reference::State& start, double duration);
// Names something that the motion depends on and the reference does not know; empty: it knows all. Beside
// what whyNoReference() names, pins that are released.
std::string beyondReference(const Scene& scene);

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

// Energy of the end less that of the reference's, over the E above.
double energyGain(const reference::Problem& problem, const reference::State& start,
                  const reference::State& exact, const reference::State& end);

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

    // Solves each of these by itself, in their order, in at most so many seconds a molecule and until the
    // time is over: where one is chaotic or too stiff the others still have their ends.
    void solveEach(const std::vector<size_t>& which, double tolerance, double secondsAMolecule,
                   const TimeLimit& limit);
    // A bound of the error of a molecule's end; infinity where nothing is known of it.
    double bound(size_t molecule) const { return molecules_[molecule].bound; }
    // Whether the last solveEach() had less time than a molecule might have taken.
    bool cutShort() const { return cutShort_; }
    // Whether more time would not help.
    bool chaotic(size_t molecule) const { return molecules_[molecule].chaotic; }

    static bool finite(const std::vector<Snapshot>& ends);
    ErrorParts errorOf(const std::vector<Snapshot>& ends) const;
    Drift driftOf(const std::vector<Snapshot>& ends) const;
    int molecules() const { return int(molecules_.size()); }
    // The group of a molecule, its number in that, and the length that errors are shares of, in m.
    size_t group(size_t molecule) const { return molecules_[molecule].group; }
    int number(size_t molecule) const { return molecules_[molecule].index; }
    double size(size_t molecule) const { return molecules_[molecule].size; }
    double errorOf(size_t molecule, const Snapshot& end) const;  // relative; the end of its group
    static reference::State stateOf(const Snapshot& snapshot, int molecule);

  private:
    struct ExactMolecule {
        size_t group = 0;
        int index = 0;  // in the group
        double size = 1, scale = 1, phase = 0;
        reference::State start, end;
        double bound = std::numeric_limits<double>::infinity();
        bool chaotic = false;
    };
    // All molecules of a group take as many steps.
    struct ExactGroup {
        const Group* group = nullptr;
        std::string name;
        double steps = 0;    // of the first run, reference::firstSteps
        bool smooth = true;  // without colliders
    };
    // It is made where it is needed, because it has copies of the scene's fields.
    reference::Problem problemOf(const ExactMolecule& molecule) const;
    Drift driftOf(const ExactMolecule& molecule, const reference::State& end) const;
    double secondsOf(const ExactMolecule& molecule, double most) const;
    bool tooStiff(const ExactMolecule& molecule, double seconds);
    Settled judge(const ExactMolecule& molecule, const reference::Solution& solution, double seconds);
    void keep(std::vector<reference::Solution>& solutions);
    std::string nameOf(const ExactMolecule& molecule) const;

    const Scene& scene_;
    std::vector<ExactGroup> groups_;  // as the plan has them
    std::vector<ExactMolecule> molecules_;
    double duration_;
    int cores_;
    double secondsPerStep_ = 0, tolerance_ = 1e30, error_ = 1e30;
    std::string why_;
    bool cutShort_ = false;
};

}  // namespace shoal::measure
