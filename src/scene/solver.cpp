#include "scene/solver.h"

#include <limits>

#include "core/error.h"

namespace shoal {

namespace {

constexpr double any = std::numeric_limits<double>::infinity();

constexpr Solver table[] = {
    {SolverKind::euler, "euler", 1, false, false, any, 2, "[Latta 2004, (3) and (8)]",
     "(wh)^2 + 4 zeta wh < 4", "nothing", "1", "the papers' baseline"},
    {SolverKind::verlet, "verlet", 1, false, false, any, 2, "[Latta 2004, (9)]", "(wh)^2 + 4 zeta wh < 4",
     "nothing", "1", "the papers' other one; floats spoil its velocity"},
    {SolverKind::leapfrog, "leapfrog", 2, false, false, any, 2, "[Verlet 1967] in velocity form",
     "(wh)^2 + 8 zeta wh < 4", "an acceleration a vertex", "1, and 1 a frame",
     "the default while w h is small"},
    {SolverKind::rk4, "rk4", 4, false, false, 2.7, 2.8, "[Kutta 1901]", "wh < 2.8", "four vectors a vertex",
     "4", "small errors in smooth scenes"},
    {SolverKind::xpbd, "xpbd", 1, true, false, any, 2, "[Macklin 2019]", "always", "two vectors a vertex",
     "1 sweep", "cheap and damped"},
    {SolverKind::bdf2Xpbd, "bdf2-xpbd", 2, true, true, any, 1.6, "BDF2 with XPBD sweeps inside", "always",
     "the last change of x and v", "2 sweeps", "the default where springs are stiff"},
    {SolverKind::bdf2Corotated, "bdf2-corotated", 2, true, true, any, 1.6,
     "BDF2 with corotated quasi-Newton steps inside", "always (guarded)",
     "the last change of x and v; a matrix a type", "2 products with a matrix, 2 sweeps",
     "the stiffest springs at small strain"},
};

}  // namespace

std::span<const Solver> solvers() {
    return table;
}

const Solver& solver(SolverKind kind) {
    return table[size_t(kind)];
}

const char* name(SolverKind kind) {
    return solver(kind).name;
}

const std::vector<std::string>& solverWords() {
    static const std::vector<std::string> words = [] {
        std::vector<std::string> out = {"auto"};
        for (const Solver& one : table)
            out.emplace_back(one.name);
        return out;
    }();
    return words;
}

std::optional<SolverKind> solverOf(const std::string& word) {
    if (word == "auto") return std::nullopt;
    for (const Solver& one : table)
        if (word == one.name) return one.kind;
    throw Error("unknown solver \"", word, "\"", suggestion(word, solverWords()));
}

}  // namespace shoal
