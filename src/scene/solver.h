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

enum class SolverKind { euler, verlet, leapfrog, rk4, xpbd, bdf2Xpbd, bdf2Corotated };

struct Solver {
    SolverKind kind;
    const char* name;    // in files and on the command line; also of its shader
    int order;           // of its error in h, in smooth motion
    bool implicit;       // no limit on w h; the fused path only
    bool history;        // keeps the change of the last substep beside the state
    double mostDragged;  // largest drag rate times h that it takes; infinite where it takes any
    double mostForced;   // frequency of a force (scene/force.h) times h up to which it is stable
    const char* source;  // where it is from
    const char* stable;  // for people: up to which step
    const char* needs;   // for people: memory and matrices
    const char* cost;    // for people: of a substep, in evaluations of the springs
    const char* use;     // for people: what for
};

// In the order of SolverKind.
std::span<const Solver> solvers();
const Solver& solver(SolverKind kind);
const char* name(SolverKind kind);

// "auto" and the names of all solvers.
const std::vector<std::string>& solverWords();
// Nothing for "auto": each group takes what suits it (compile/choose_solver.h).
// Error: another word, with the nearest.
std::optional<SolverKind> solverOf(const std::string& word);

}  // namespace shoal
