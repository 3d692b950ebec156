#include "scene/solver.h"

#include <limits>

#include "core/error.h"
#include "molecule/analysis.h"

namespace shoal {

namespace {

constexpr double any = std::numeric_limits<double>::infinity();

// An explicit Runge-Kutta method; what follows from its stages is filled in.
constexpr Solver rungeKutta(SolverKind kind, const char* name, int order, const Tableau& tableau) {
    return {.kind = kind,
            .name = name,
            .order = order,
            .mostDragged = tableau.decaying,
            .mostForced = tableau.oscillating,
            .evaluations = double(tableau.stages),
            .vectors = 5,
            .secondsPerSpring = 0.0012 * tableau.stages,
            .tableau = tableau};
}

constexpr Solver table[] = {
    // The papers' baseline [Latta 2004, (3) and (8)].
    {.kind = SolverKind::euler,
     .name = "euler",
     .order = 1,
     .mostDragged = any,
     .mostForced = 2,
     .evaluations = 1,
     .vectors = 1,
     .secondsPerSpring = 0.0013,
     .stableStep = &Analysis::stableStepEuler},
    // The papers' other one [Latta 2004, (9)]; floats spoil its velocity.
    {.kind = SolverKind::verlet,
     .name = "verlet",
     .order = 1,
     .mostDragged = any,
     .mostForced = 2,
     .evaluations = 1,
     .vectors = 1,
     .secondsPerSpring = 0.0013,
     .stableStep = &Analysis::stableStepEuler},
    // [Verlet 1967] in velocity form: the default while w h is small.
    {.kind = SolverKind::leapfrog,
     .name = "leapfrog",
     .order = 2,
     .mostDragged = any,
     .mostForced = 2,
     .evaluations = 1,
     .perFrame = 1,
     .vectors = 2,
     .secondsPerSpring = 0.0042,
     .stableStep = &Analysis::stableStepLeapfrog},
    // [Kutta 1901]: small errors in smooth scenes.
    rungeKutta(SolverKind::rk4, "rk4", 4,
               {.stages = 4,
                .a = {{}, {0.5}, {0, 0.5}, {0, 0, 1}},
                .b = {1 / 6.0, 1 / 3.0, 1 / 3.0, 1 / 6.0},
                .disc = 2.6,
                .decaying = 2.7,
                .oscillating = 2.8}),
    // [Macklin 2019], one sweep: cheap and damped.
    {.kind = SolverKind::xpbd,
     .name = "xpbd",
     .order = 1,
     .implicit = true,
     .mostDragged = any,
     .mostForced = 2,
     .evaluations = 1,
     .vectors = 2,
     .secondsPerSpring = 0.0021},
    // BDF2 with two XPBD sweeps inside: the default where springs are stiff.
    {.kind = SolverKind::bdf2Xpbd,
     .name = "bdf2-xpbd",
     .order = 2,
     .implicit = true,
     .history = true,
     .mostDragged = any,
     .mostForced = 1.6,
     .evaluations = 2,
     .vectors = 4,
     .secondsPerSpring = 0.0246},
    // BDF2 with two corotated quasi-Newton steps inside, guarded, with a matrix a type: the stiffest springs
    // at small
    // strain.
    {.kind = SolverKind::bdf2Corotated,
     .name = "bdf2-corotated",
     .order = 2,
     .implicit = true,
     .history = true,
     .mostDragged = any,
     .mostForced = 1.6,
     .evaluations = 2,
     .vectors = 5,
     .secondsPerSpring = 0.0653},
    // BDF2 whose stage is solved, by Newton steps with the molecule's own matrix: large stiff molecules, long
    // chains under load, and springs whose damping outweighs all else.
    {.kind = SolverKind::bdf2Newton,
     .name = "bdf2-newton",
     .order = 2,
     .implicit = true,
     .spread = true,
     .history = true,
     .mostDragged = any,
     .mostForced = 1.6,
     .evaluations = 3,
     .vectors = 5,
     .secondsPerSpring = 0},
};

// Whether solver(kind) finds each in its place, with a limit where it has one and stages that the shader can
// do.
consteval bool sound() {
    for (size_t i = 0; i < std::size(table); ++i) {
        const Solver& solver = table[i];
        if (size_t(solver.kind) != i || !solver.tableau.needsOneSum()) return false;
        if (solver.tableau.stages > 0 && solver.tableau.disc <= 0) return false;
        if (int(solver.implicit) + int(solver.stableStep != nullptr) + int(solver.tableau.stages > 0) != 1)
            return false;
    }
    return std::size(table) > size_t(SolverKind::bdf2Newton);
}
static_assert(sound());

}  // namespace

std::span<const Solver> solvers() {
    return table;
}

const Solver& solver(SolverKind kind) {
    return table[size_t(kind)];
}

double Solver::longestStep(const Analysis& analysis) const {
    if (implicit) return any;
    if (!rungeKutta()) return analysis.*stableStep;
    return analysis.fastestRate > 0 ? tableau.disc / analysis.fastestRate : any;
}

const char* name(SolverKind kind) {
    return solver(kind).name;
}

const std::vector<std::string>& solverWords() {
    static const std::vector<std::string> words = [] {
        std::vector<std::string> out = {"auto"};
        for (const Solver& solver : table)
            out.emplace_back(solver.name);
        return out;
    }();
    return words;
}

std::optional<SolverKind> solverOf(const std::string& word) {
    if (word == "auto") return std::nullopt;
    for (const Solver& solver : table)
        if (word == solver.name) return solver.kind;
    throw Error("unknown solver \"", word, "\"", suggestion(word, solverWords()));
}

}  // namespace shoal
