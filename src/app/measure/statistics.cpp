// `shoal measure --statistics`: how far the statistics of methods are from a reference's, where paths part.
#include <iostream>
#include <sstream>

#include "app/measure/measure.h"
#include "core/file.h"
#include "core/printable.h"
#include "core/table.h"
#include "gpu/program_cache.h"
#include "measure/statistics.h"
#include "run/progress.h"

namespace shoal::app {

using namespace measure;

namespace {

constexpr Column statisticColumns[] = {{"row", "statistic", -34},
                                       {"reference.mean", "reference", 11, "%.4g"},
                                       {"reference.interval", "+-", 9, "%.1g"},
                                       {"value.mean", "method", 11, "%.4g"},
                                       {"value.interval", "+-", 9, "%.1g"},
                                       {"difference.mean", "difference", 11, "%.2g"},
                                       {"difference.interval", "+-", 9, "%.1g"},
                                       {"relative.mean", "relative", 9, "%.3f"},
                                       {"relative.interval", "+-", 8, "%.3f"},
                                       {"differs", "differs", 9}};
const char
    *statisticCsvHead =
        "solver,substeps,group,quantity,unit,statistic,reference,referenceInterval,value,valueInterval,"
        "difference,differenceInterval,scale,relative,relativeInterval,differs",
    *statisticCsvKeys =
        "solver,substeps,group,quantity,unit,statistic,reference.mean,reference.interval,value.mean,"
        "value.interval,difference.mean,difference.interval,scale,relative.mean,relative.interval,differs";

JsonValue asJson(const Estimate& estimate) {
    return object(key("mean", estimate.mean), key("interval", estimate.half));
}

// |difference| over the scale.
JsonValue relativeOf(const Difference& difference) {
    if (!difference.scale) return {};
    return asJson(Estimate{*difference.relative(), difference.difference.half / *difference.scale});
}

JsonValue asJson(const Difference& difference) {
    return object(key("group", difference.group), key("quantity", difference.quantity),
                  key("unit", difference.unit), key("statistic", difference.statistic),
                  key("reference", asJson(difference.reference)), key("value", asJson(difference.value)),
                  key("difference", asJson(difference.difference)), key("scale", difference.scale),
                  key("relative", relativeOf(difference)), key("differs", name(difference.verdict)));
}

JsonValue worstAsJson(const std::vector<Difference>& differences, const std::optional<size_t>& worst) {
    return worst ? asJson(differences[*worst]) : JsonValue();
}

int differing(const std::vector<Difference>& differences) {
    int out = 0;
    for (const Difference& difference : differences)
        out += difference.verdict == Verdict::differs;
    return out;
}

JsonValue asJson(const StatisticsMethod& method) {
    JsonValue out = object(key("solver", method.solver), key("substeps", method.substeps),
                           key("outcome", name(method.outcome)));
    if (!method.why.empty()) append(out, key("why", method.why));
    if (method.outcome != Outcome::measured) return out;
    return append(out, key("worst", worstAsJson(method.differences, method.worst)),
                  key("within", method.within), key("differing", differing(method.differences)),
                  key("statistics", arrayOf(method.differences, asJson)));
}

JsonValue asJson(const StatisticsReference& reference) {
    JsonValue out = object(key("precision", reference.isDouble ? "double" : "single"),
                           key("solver", reference.solver), key("longestStep", reference.step));
    if (!reference.isDouble) append(out, key("substeps", reference.substeps), key("why", reference.why));
    return append(out, key("converged", reference.settled),
                  key("halving", worstAsJson(reference.halving, reference.worst)));
}

JsonValue asJson(const StatisticsGroup& group) {
    return object(key("name", group.name), key("molecule", group.molecule), key("molecules", group.molecules),
                  key("vertices", group.vertices));
}

JsonValue asJson(const StatisticsReport& report, const bench::MeasuredOn& machine) {
    JsonValue out = firstKeys(machine);
    return append(out, key("scene", report.scene), key("path", name(report.path)),
                  key("frameRate", report.frameRate), key("duration", report.duration),
                  key("seconds", report.seconds), key("firstSeed", report.firstSeed),
                  key("seeds", report.seeds), key("displaced", report.displaced),
                  key("groups", arrayOf(report.groups, asJson)), key("reference", asJson(report.reference)),
                  key("notes", report.notes), key("methods", arrayOf(report.methods, asJson)));
}

// A row a statistic, with the method that it is of.
std::vector<JsonValue> rowsOf(const StatisticsReport& report) {
    std::vector<JsonValue> out;
    for (const StatisticsMethod& method : report.methods) {
        const std::string words = concat(method.solver, ", ", many(method.substeps, "substep", "substeps"));
        for (const Difference& difference : method.differences) {
            const std::string unit = difference.unit.empty() ? "" : concat(", ", difference.unit);
            append(out.emplace_back(asJson(difference)), key("solver", method.solver),
                   key("substeps", method.substeps),
                   key("method", concat(words, ": ", printable(difference.group))),
                   key("row", concat(difference.quantity, unit, ", ", difference.statistic)));
        }
    }
    return out;
}

// "0.034 +- 0.012 standard deviations (speed, 95 %, of "fry")"
std::string furthest(const std::vector<Difference>& differences, const std::optional<size_t>& worst) {
    if (!worst) return "nothing that has a scale";
    const Difference& difference = differences[*worst];
    return concat(formatted("%.3f", *difference.relative()), " +- ",
                  formatted("%.3f", difference.difference.half / *difference.scale), " standard deviations (",
                  difference.quantity, ", ", difference.statistic, ", of \"", printable(difference.group),
                  "\")");
}

void addReference(std::ostringstream& out, const StatisticsReference& reference) {
    out << "reference: " << reference.solver;
    if (reference.isDouble)
        out << " in double precision on the CPU, in steps of " << shortNumber(reference.step * 1e6)
            << " us and less\n";
    else
        out << " with " << many(reference.substeps, "substep", "substeps")
            << " on the device, because the one in double precision knows no " << reference.why << "\n";
    out << "  halving its step has changed it by up to " << furthest(reference.halving, reference.worst)
        << (reference.settled ? "\n" : ": it has not converged\n");
}

std::string asText(const StatisticsReport& report, const bench::MeasuredOn& machine) {
    std::ostringstream out;
    out << bench::asText(machine) << "; " << name(report.path) << " path\n"
        << "\"" << printable(report.scene) << "\": after " << report.duration << " s at " << report.frameRate
        << " frames a second, seeds " << report.firstSeed << " to "
        << report.firstSeed + uint64_t(report.seeds) - 1 << "\n";
    for (const StatisticsGroup& group : report.groups)
        out << "  " << printable(group.name) << ": " << many(group.molecules, "molecule", "molecules")
            << " of " << many(group.vertices, "vertex", "vertices") << "\n";
    addReference(out, report.reference);
    if (report.displaced > 0)
        out << "starts do not depend on the seed: each molecule is displaced by " << report.displaced
            << " of its size and turned by as many rad, at random\n";
    out << "relative: of the standard deviation among the reference's molecules; +-: 95 % confidence\n";
    out << tableText(statisticColumns, rowsOf(report), "method") << "\n";
    for (const std::string& note : report.notes)
        out << "note: " << printable(note) << "\n";
    for (const StatisticsMethod& method : report.methods) {
        out << method.solver << " with " << many(method.substeps, "substep", "substeps") << ": ";
        if (method.outcome != Outcome::measured)
            out << name(method.outcome) << ": " << printable(method.why) << "\n";
        else
            out << "statistics off by up to " << furthest(method.differences, method.worst) << "; "
                << differing(method.differences) << " of " << method.differences.size() << " differ\n";
    }
    return out.str();
}

}  // namespace

int statisticsCommand(const Options& options) {
    if (!options.csv.empty()) checkWritable(options.csv);
    const Scene scene = readScene(options.files.front(), options);
    tellWarnings(scene.warnings);
    gpu::Context context(hiddenContext(options));
    StatisticsReport report;
    {
        Progress bar("statistics, per cent", 100);
        const StatisticsOptions wanted{.seeds = options.seeds,
                                       .duration = options.duration,
                                       .molecules = options.molecules,
                                       .solvers = options.solvers,
                                       .substeps = options.eachSubsteps,
                                       .seconds = options.seconds,
                                       .tell = [&](double share) { bar.reach(int(100 * share)); }};
        report = measureStatistics(scene, wanted, accuracyDevice(options, context));
    }
    const bench::MeasuredOn machine = bench::measuredOn(context, SHOAL_VERSION);
    tellWarnings(context.cache().takeWarnings());
    std::cout << (options.json ? writeJson(asJson(report, machine)) : asText(report, machine));
    if (!options.csv.empty())
        writeFile(options.csv, tableCsv(statisticCsvHead, statisticCsvKeys, rowsOf(report)));
    if (!options.csv.empty() && !options.json) std::cout << "\ntable: " << printable(options.csv) << "\n";
    return 0;
}

}  // namespace shoal::app
