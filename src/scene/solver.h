// The methods that advance a molecule, and what to know of each. Definitions: shaders/solver/<name>.glsl; the
// same in double precision: tests/reference/discrete.h. h is a substep, w the molecule's highest frequency.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shoal {

// Drag rate times substep beyond which leapfrog lets velocities slip (simulate/step.h).
constexpr double slipFrom = 1;

struct Analysis;  // molecule/analysis.h

// A solver is a row of the table in solver.cpp. Here are the names of those that code asks for.
enum class SolverKind { euler, verlet, leapfrog, rk4, xpbd, bdf2Xpbd, bdf2Corotated, bdf2Newton };

// The Butcher tableau of an explicit Runge-Kutta method. Stage s takes its rates k_s of position and velocity
// at start + h (sum of a[s][j] k_j over j < s), and a substep ends at start + h (sum of b[s] k_s).
struct Tableau {
    static constexpr int most = 4;
    int stages = 0;  // 0: the solver is no such method
    double a[most][most] = {}, b[most] = {};
    // Rates times h up to which it is stable: of all in the left half of the complex plane, of those that
    // decay, and of those that oscillate.
    double disc = 0, decaying = 0, oscillating = 0;

    constexpr double time(int stage) const {  // in substeps
        double sum = 0;
        for (int j = 0; j < stage; ++j)
            sum += a[stage][j];
        return sum;
    }

    // Where stage s leads, to the next stage or to the substep's end: start + h (rate k_s + sum S), with S
    // the sum of b[j] k_j over j <= s. So a shader keeps the start and S, and no rates of earlier stages.
    struct Way {
        double rate, sum;
    };
    constexpr Way way(int stage) const {
        if (stage == stages - 1) return {0, 1};
        const double* next = a[stage + 1];
        const double sum = stage > 0 && next[0] != 0 ? next[0] / b[0] : 0,
                     rate = next[stage] - sum * b[stage];
        return {rate < 1e-12 && rate > -1e-12 ? 0 : rate, sum};
    }
    // Whether way() gives the method; others would need the rates of every stage.
    constexpr bool needsOneSum() const {
        for (int stage = 0; stage + 1 < stages; ++stage)
            for (int j = 0; j < stage; ++j) {
                const double off = a[stage + 1][j] - way(stage).sum * b[j];
                if (off > 1e-12 || off < -1e-12) return false;
            }
        return true;
    }
};

struct Solver {
    SolverKind kind;
    const char* name;         // in files and on the command line
    int order;                // of its error in h, in smooth motion
    bool implicit = false;    // no limit on w h; the fused path only
    bool spread = false;      // over lanes: has a lane a vertex, in compute shaders alone (compile/newton.h)
    bool history = false;     // keeps the change of the last substep beside the state
    double mostDragged;       // largest drag rate times h that it takes; infinite where it takes any
    double mostForced;        // frequency of a force (scene/force.h) times h up to which it is stable
    double evaluations;       // of the springs in a substep
    double perFrame = 0;      // and beside those in a frame
    int vectors;              // that it keeps a vertex beside position and velocity
    double secondsPerSpring;  // that a CPU rasteriser compiles (compile/lanes.cpp)
    // The longest substep, of explicit methods without a tableau.
    double Analysis::*stableStep = nullptr;
    Tableau tableau = {};

    bool rungeKutta() const { return tableau.stages > 0; }
    // The longest substep with which springs are stable, s; infinite where any is.
    double longestStep(const Analysis& analysis) const;
    // The file of shaders/solver that holds it: its name, or one for all Runge-Kutta methods.
    const char* shader() const { return rungeKutta() ? "runge-kutta" : name; }
};

// Each at the place of its kind.
std::span<const Solver> solvers();
const Solver& solver(SolverKind kind);
const char* name(SolverKind kind);

// "auto" and the names of all solvers.
const std::vector<std::string>& solverWords();
// Nothing for "auto": each group takes what suits it (compile/choose_solver.h).
// Error: another word, with the nearest.
std::optional<SolverKind> solverOf(const std::string& word);

}  // namespace shoal
