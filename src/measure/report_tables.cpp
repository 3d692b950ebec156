#include "measure/report_scenes.h"

#include <cmath>
#include <sstream>

#include "measure/timing.h"

namespace shoal::measure {

namespace {

// Two digits that count, three above 100.
std::string times(double ratio) {
    return formatted(ratio < 9.95 ? "%.1f" : "%.0f", ratio);
}
std::string power(double k) {
    return concat("k = 1e", int(std::lround(std::log10(k))));
}

const ReportEntry* find(const std::vector<ReportEntry>& entries, const std::string& molecule,
                        const std::string& motion, double stiffness) {
    for (const ReportEntry& entry : entries)
        if (entry.molecule == molecule && entry.motion == motion && entry.stiffness == stiffness)
            return &entry;
    return nullptr;
}

std::optional<BestOf> cheapest(const std::vector<AccuracyPoint>& points, double error) {
    std::optional<BestOf> best;
    for (const Solver& solver : solvers()) {
        const std::optional<BestOf> found = bestOf(points, solver.kind, error);
        if (found && (!best || found->cost.time < best->cost.time)) best = found;
    }
    return best;
}

// Fields read less often than the solver's own are named.
std::string methodWords(const Method& method) {
    std::string out = name(method.solver);
    if (method.sampling != FieldSampling::vertexSubstep) out += concat(" (", name(method.sampling), ")");
    return out;
}

// Why a solver has no cost at an error.
std::string notReached(const std::vector<AccuracyPoint>& points, std::optional<SolverKind> kind) {
    for (const AccuracyPoint& point : points)
        if (point.outcome == Outcome::leftOut && (!kind || point.method.solver == *kind))
            return "not reached in the time given";
    return "not reached";
}

// "leapfrog 58×": ≥ where the cheaper one could take larger steps than a frame has, ≤ where euler could.
std::string speedUp(const ReportEntry& entry, double error) {
    if (!entry.accuracy.chaotic.empty()) return "chaotic";
    if (!entry.accuracy.tooStiff.empty()) return "too stiff";
    const std::vector<AccuracyPoint>& points = entry.accuracy.points;
    const std::optional<BestOf> best = cheapest(points, error);
    if (!best) return notReached(points, {});
    const std::optional<BestOf> euler = bestOf(points, SolverKind::euler, error);
    std::string words = methodWords(best->method);
    if (!euler) return concat(words, "; euler ", notReached(points, SolverKind::euler));
    if (best->method.solver == SolverKind::euler) return words;
    const bool least = best->cost.atLargestStep, most = euler->cost.atLargestStep;
    return concat(words, " ",
                  least == most ? ""
                  : least       ? "≥ "
                                : "≤ ",
                  times(euler->cost.time / best->cost.time), "×");
}

std::string row(const std::vector<std::string>& cells) {
    std::string out = "|";
    for (const std::string& cell : cells)
        out += " " + cell + " |";
    return out + "\n";
}

std::string head(const std::vector<std::string>& cells) {
    std::string out = row(cells) + "|";
    for (size_t i = 0; i < cells.size(); ++i)
        out += "---|";
    return out + "\n";
}

// A row a motion and molecule with one cell for each stiffness.
template <typename Cell>
std::string byStiffness(const std::vector<ReportEntry>& entries, const Cell& cell) {
    std::vector<std::string> names = {"motion, molecule"};
    for (const double k : reportStiffnesses)
        names.push_back(power(k));
    std::string out = head(names);
    for (const char* motion : reportMotions) {
        for (const char* molecule : reportMolecules) {
            std::vector<std::string> cells = {concat(motion, ", ", molecule)};
            bool any = false;
            for (const double k : reportStiffnesses) {
                const ReportEntry* entry = find(entries, molecule, motion, k);
                any |= entry != nullptr;
                cells.push_back(entry != nullptr ? cell(*entry) : "");
            }
            if (any) out += row(cells);
        }
    }
    return out;
}

}  // namespace

std::string speedUpTable(const std::vector<ReportEntry>& entries, double error) {
    return byStiffness(entries, [&](const ReportEntry& entry) { return speedUp(entry, error); });
}

std::string costTable(const std::vector<ReportEntry>& entries, double error) {
    std::vector<std::string> names = {"scene"};
    for (const Solver& solver : solvers())
        names.emplace_back(solver.name);
    std::string out = head(names);
    for (const ReportEntry& entry : entries) {
        if (!entry.accuracy.hasErrors()) continue;
        std::vector<std::string> cells = {
            concat(entry.motion, ", ", entry.molecule, ", ", power(entry.stiffness))};
        for (const Solver& solver : solvers()) {
            const std::optional<BestOf> found = bestOf(entry.accuracy.points, solver.kind, error);
            cells.push_back(found
                                ? concat(found->cost.atLargestStep ? "≤ " : "", nanoseconds(found->cost.time))
                                : notReached(entry.accuracy.points, solver.kind));
        }
        out += row(cells);
    }
    return out;
}

std::string chosenTable(const std::vector<ReportEntry>& entries) {
    return byStiffness(entries, [](const ReportEntry& entry) -> std::string {
        if (!entry.chosen) return "none";
        return concat(methodWords(entry.chosen->method), " ", entry.chosen->substeps);
    });
}

}  // namespace shoal::measure
