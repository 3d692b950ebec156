#include "app/bench.h"

#include <iomanip>
#include <sstream>

namespace shoal::app {

using namespace bench;

namespace {

// Three digits that count, without an exponent.
std::string short3(double value) {
    return formatted("%.*f", value < 10 ? 2 : value < 100 ? 1 : 0, value);
}

std::string orDash(const std::optional<double>& value) {
    return value ? short3(*value) : "-";
}

constexpr int benchColumns[] = {-40, 10, 11, 11, 9, 9, 7, 8, 7, 7, 7, 6};

std::string rowOf(const BenchResult& result, const std::vector<BenchResult>& all) {
    const std::string label = "  " + result.benchCase.label;
    if (!result.leftOut.empty())
        return formatted("%*s   left out: %s\n", benchColumns[0], label.c_str(), result.leftOut.c_str());
    if (!result.failed.empty())
        return formatted("%*s   failed: %s\n", benchColumns[0], label.c_str(), result.failed.c_str());
    const Ratios ratios = ratiosOf(result, all);
    const auto each = [&](size_t bytes) -> std::string {
        return bytes > 0 ? formatted("%.0f", double(bytes) / result.benchCase.count) : "-";
    };
    return tableRow(
        {label, formatted("%.3f", result.frame.min * 1e3), formatted("%.3f", result.frame.median * 1e3),
         deviceMilliseconds(result.device),
         result.benchCase.subject == Subject::multiplyAdd ? "-" : short3(result.perMolecule() * 1e9),
         orDash(ratios.avx512), orDash(ratios.avx2), orDash(ratios.pingPong), each(result.stateBytes),
         each(result.movedBytes), ratios.bandwidth ? short3(*ratios.bandwidth * 1e-9) : "-",
         ratios.shareOfCopy ? formatted("%.0f%%", *ratios.shareOfCopy * 100) : "-"},
        benchColumns);
}

void addTimes(std::ostringstream& out, const std::vector<BenchResult>& results) {
    std::string group;
    for (const BenchResult& result : results) {
        if (result.benchCase.group != group) {
            group = result.benchCase.group;
            out << "\n"
                << tableRow({group, "min ms", "median ms", "device ms", "ns each", "/AVX-512", "/AVX2",
                             "vs p-p", "state", "moved", "GB/s", "copy"},
                            benchColumns);
        }
        out << rowOf(result, results);
    }
}

// `whole`: nothing was left out by wish.
void addVerdicts(std::ostringstream& out, const std::vector<Target>& all, bool whole) {
    const auto list = [&](const char* title, auto&& belongs) {
        bool any = false;
        for (const Target& target : all) {
            if (!belongs(target)) continue;
            if (!any) out << "\n" << title << "\n";
            any = true;
            out << "  " << sentence(target) << "\n";
        }
    };
    list("These targets hold in this run:", [](const Target& t) { return t.holds(); });
    list("These do not:", [](const Target& t) { return t.measured && !t.holds(); });
    if (whole) list("These were not measured:", [](const Target& t) { return !t.measured; });
}

void addDistances(std::ostringstream& out, const std::vector<BenchResult>& results) {
    const std::vector<std::string> lines = distances(results);
    if (!lines.empty()) out << "\nhow near the device's own limits\n";
    for (const std::string& line : lines)
        out << "  " << line << "\n";
}

void addErrors(std::ostringstream& out, const BenchReport& report) {
    if (report.errors.empty()) return;
    out << "\nerror after 1 s, quads in the air, against double precision; ns each of so many quads\n";
    const char* row = "  %-46s%12s%10s%10s\n";
    out << formatted(row, "", "error", "16,384", "131,072");
    for (const BenchError& error : report.errors) {
        const auto speed = [&](int count) -> std::string {
            const BenchResult* result = speedOf(error, count, report.results);
            return result ? short3(result->perMolecule() * 1e9) : "-";
        };
        const std::string what = concat(name(error.subject), ", ", shoal::name(error.solver), ", ",
                                        name(error.wind), ", ", shoal::name(error.sampling));
        out << formatted(row, what.c_str(), error.relative ? formatted("%.1e", *error.relative).c_str() : "-",
                         speed(16384).c_str(), speed(131072).c_str());
    }
}

void addStarts(std::ostringstream& out, const BenchReport& report) {
    if (report.starts.empty()) return;
    out << formatted(
        "\nstart-up, ms: the context %.0f; plan, then simulation and first frame: unseen kernel, in the "
        "driver's cache, in ours\n",
        report.contextSeconds * 1e3);
    for (const StartTime& start : report.starts)
        out << formatted(
            "  %-34s%10.0f%10.0f%10.0f%10.0f\n",
            concat(grouped(start.count), " ", start.molecule, ", ", shoal::name(start.solver)).c_str(),
            start.compile * 1e3, start.cold * 1e3, start.driver * 1e3, start.cached * 1e3);
}

std::string minAndMedian(double min, double median) {
    return formatted("%20s", formatted("%.2f / %.2f", min * 1e3, median * 1e3).c_str());
}

// Tables of one path and solver side by side, one column each size.
void addPassTable(std::ostringstream& out, const std::vector<const PassTable*>& sizes) {
    const PassTable& first = *sizes.front();
    out << "\npasses of quads, " << name(first.subject) << ", " << shoal::name(first.solver)
        << "; all calls of a frame, min / median ms\n  pass       calls";
    for (const PassTable* size : sizes)
        out << formatted("%20s", grouped(size->count).c_str());
    out << "\n";
    for (size_t i = 0; i < first.passes.size(); ++i) {
        out << "  " << std::left << std::setw(10) << first.passes[i].name << std::right << std::setw(6)
            << first.passes[i].calls;
        for (const PassTable* size : sizes)
            out << minAndMedian(size->passes[i].min, size->passes[i].median);
        out << "\n";
    }
    out << "  frame           ";
    for (const PassTable* size : sizes)
        out << minAndMedian(size->frame.min, size->frame.median);
    out << "\n";
}

void addPasses(std::ostringstream& out, const std::vector<PassTable>& tables) {
    for (const Subject subject : {Subject::fused, Subject::fragments, Subject::pingPong}) {
        for (const SolverKind solver : {SolverKind::euler, SolverKind::leapfrog}) {
            std::vector<const PassTable*> sizes;
            for (const PassTable& table : tables)
                if (table.subject == subject && table.solver == solver) sizes.push_back(&table);
            if (!sizes.empty()) addPassTable(out, sizes);
        }
    }
}

}  // namespace

std::string asText(const std::vector<Target>& targets, const char* format) {
    std::string out;
    for (const Target& target : targets)
        out +=
            concat(target.what, ": ", target.measured ? formatted(format, *target.measured) : "not measured",
                   target.measured
                       ? formatted(" (wanted: at %s %g)", target.atLeast ? "least" : "most", target.limit)
                       : "",
                   "\n");
    return out;
}

std::string asText(const BenchReport& report) {
    std::ostringstream out;
    out << twoLines(report.machine) << "\n"
        << "euler, 4 substeps a frame of 1/60 s unless a case says otherwise; pictures of " << pictureWidth
        << " x " << pictureHeight << ".\n"
        << "min, median: wall time; device: the device's own, the shortest, where it is no processor.\n"
        << "ns each and the ratios are of the shortest times. /AVX-512, /AVX2: times as long as that "
           "baseline.\n"
        << "vs p-p: times as fast as ping-pong. state, moved: bytes of a molecule, kept on the device and "
           "read\n"
        << "and written in a frame. GB/s: moved over time; copy: as a share of the fastest copy's.\n";
    addTimes(out, report.results);
    addDistances(out, report.results);
    addErrors(out, report);
    addStarts(out, report);
    addPasses(out, report.passes);
    addVerdicts(out, targets(report.results, report.machine.context.software), report.whole);
    if (const int count = disturbed(report.results))
        out << "\nIn " << count << " of " << report.results.size()
            << " cases the median is more than 1.3 times the shortest: something else was running. Measure "
               "again\n"
               "on a quiet machine before believing a ratio.\n";
    return out.str();
}

}  // namespace shoal::app
