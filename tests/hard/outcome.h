// A hard case is run by every solver of the table and has an outcome with each: it passes, it refuses (an
// Error before the first frame says why), or it fails honestly with a finite figure. Which one is written
// down in docs/hard-cases.tsv; another outcome, better or worse, turns the test red, and so does any value
// that is not finite. SHOAL_UPDATE_HARD=1 renews it (hard/table.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gl/numerics.h"

namespace shoal::test {

enum class Verdict { passes, refuses, fails, notFinite };
const char* word(Verdict verdict);

struct Outcome {
    Verdict verdict = Verdict::passes;
    std::string figure;  // for people: what was measured, or the refusal
};

// Collects what a case measures. A label may come many times: the worst value is shown.
class Judge {
  public:
    void atMost(const std::string& what, double value, double limit);
    void near(const std::string& what, double value, double expected, double margin);
    void report(const std::string& what, double value);  // a figure without a limit, which must be finite
    void finite(const Snapshot& snapshot);               // every number of it
    Outcome outcome() const;

  private:
    struct Figure {
        std::string what;
        double value = 0, badness = 0;  // badness: above 1 it fails
    };
    void add(Figure figure);
    std::vector<Figure> figures_;
    bool finite_ = true;
};

// Runs the case with one solver, which its scenes must name. Throws what the simulation throws.
using HardCase = std::function<void(const Solver& solver, Judge& judge)>;

// Runs it with every solver and compares with the case `name` of that file.
void holds(const std::string& name, const HardCase& hardCase);

// Simulations of this run take the ping-pong path, on which an implicit solver is refused.
bool onPingPong();

// numerics.h's, with the programs kept on disk.
Simulation hardSimulation(const Scene& scene, bool drawn = false);
// Frames, and what the watchdog says of the last of them.
void runChecked(Simulation& simulation, int frames);
// Starts again from the scene's start with `edit` done to it; solvers with history start without any.
void startFrom(Simulation& simulation, const std::function<void(GroupState&)>& edit);

// Where a vertex lies in a state that startFrom edits, in world coordinates.
glm::dvec3 placeOf(const GroupState& state, size_t vertex);
void moveTo(GroupState& state, size_t vertex, const glm::dvec3& position);
void scaleMolecules(GroupState& state, const glm::dvec3& factors);  // each about its first vertex

// Half a metre wide, on one of its faces, all six pairs sprung: no soft mode, and it stands.
Molecule tetrahedron(double stiffness, double damping);

// Returns the largest relative error of a velocity after so many steps of a method that divides a
// displacement by the step, as verlet and xpbd do: a device's division may err by a rounding, 6e-8, always in
// the same direction.
double divided(const Solver& solver, int steps);

// RMS over the springs of one molecule of l / L - 1.
double strainOf(const Molecule& molecule, const reference::State& state);

}  // namespace shoal::test
