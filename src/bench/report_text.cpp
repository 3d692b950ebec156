#include "bench/reports.h"

#include <sstream>

#include "core/table.h"

namespace shoal::bench {

namespace {

constexpr Column caseColumns[] = {{"case", "case", -38},
                                  {"minSeconds", "min ms", 10, "%.3f", 1e3},
                                  {"medianSeconds", "median ms", 11, "%.3f", 1e3},
                                  {"deviceMinSeconds", "device ms", 11, "%.3f", 1e3},
                                  {"nanosecondsPerMolecule", "ns each", 9},
                                  {"overAvx512", "/AVX-512", 9},
                                  {"overAvx2", "/AVX2", 7},
                                  {"fasterThanPingPong", "vs p-p", 8},
                                  {"stateBytesPerMolecule", "state", 7, "%.0f"},
                                  {"movedBytesPerFrame", "moved", 7, "%.0f", 1, "count"},
                                  {"bytesPerSecond", "GB/s", 7, nullptr, 1e-9},
                                  {"shareOfCopy", "copy", 6, "%.0f%%", 100}};
constexpr Column errorColumns[] = {{"subject", "case", -11},
                                   {"solver", "solver", -10},
                                   {"wind", "wind", -9},
                                   {"fieldSampling", "fields", -15},
                                   {"relativeError", "error", 10, "%.1e"},
                                   {"nanosecondsPerMolecule16384", "16,384", 10},
                                   {"nanosecondsPerMolecule131072", "131,072", 10}};
constexpr Column startColumns[] = {{"molecule", "molecule", -10},
                                   {"count", "count", 9, "%.0f"},
                                   {"solver", "solver", 10},
                                   {"planSeconds", "plan", 9, "%.0f", 1e3},
                                   {"coldSeconds", "unseen", 9, "%.0f", 1e3},
                                   {"driverCacheSeconds", "driver's", 10, "%.0f", 1e3},
                                   {"programCacheSeconds", "ours", 9, "%.0f", 1e3}};
constexpr Column passColumns[] = {{"stage", "pass", -10},
                                  {"callsPerFrame", "calls", 7, "%.0f"},
                                  {"minSeconds", "min ms", 10, "%.2f", 1e3},
                                  {"medianSeconds", "median ms", 11, "%.2f", 1e3}};

constexpr Column targetColumns[] = {{"target", "target", -76},   {"measured", "measured", 9},
                                    {"atLeast", "at least", 10}, {"atMost", "at most", 10},
                                    {"ofMedians", "medians", 9}, {"holds", "holds", 7}};

void addDistances(std::ostringstream& out, const std::vector<BenchResult>& results) {
    const std::vector<std::string> lines = distances(results);
    if (!lines.empty()) out << "\nhow near the device's own limits\n";
    for (const std::string& line : lines)
        out << "  " << line << "\n";
}

}  // namespace

std::string targetText(const JsonValue& report, bool whole) {
    std::vector<JsonValue> rows;
    for (const JsonValue& target : report.find("targets")->items) {
        const JsonValue &measured = *target.find("measured"), *least = target.find("atLeast");
        const bool known = measured.kind != JsonValue::Kind::null;
        if (!known && !whole) continue;
        rows.push_back(target);
        if (known && !target.find("holds"))
            append(rows.back(), key("holds", least ? measured.number >= least->number
                                                   : measured.number <= target.find("atMost")->number));
    }
    return (rows.empty() ? "" : "\n") + tableText(targetColumns, rows);
}

std::string leftOutText(const std::vector<std::string>& leftOut) {
    if (leftOut.empty()) return {};
    return concat("\nLeft out, because the time of --quick was over (--seconds gives each group its own): ",
                  joined(leftOut, "; "), ".\n");
}

std::string asText(const BenchReport& report) {
    const JsonValue json = asJson(report);
    const auto rows = [&](const char* key) { return json.find(key)->items; };
    std::ostringstream out;
    out << asText(report.machine) << "\n"
        << "euler, 4 substeps a frame of 1/60 s unless a case says otherwise; pictures of " << pictureWidth
        << " x " << pictureHeight << ".\n"
        << "min, median: wall time; device: the device's own, the shortest, where it is no processor.\n"
        << "ns each and the ratios are of the shortest times. /AVX-512, /AVX2: times as long as that "
           "baseline.\n"
        << "vs p-p: times as fast as ping-pong. state, moved: bytes of a molecule, kept on the device and "
           "read\n"
        << "and written in a frame. GB/s: moved over time; copy: as a share of the fastest copy's.\n";
    out << tableText(caseColumns, rows("cases"), "group");
    addDistances(out, report.results);
    if (!report.errors.empty())
        out << "\nerror after 1 s, quads in the air, against double precision; ns each of so many quads\n"
            << tableText(errorColumns, rows("errors"));
    if (!report.starts.empty())
        out << formatted(
                   "\nstart-up, ms: the context %.0f; plan, then simulation and first frame: unseen kernel, "
                   "in the "
                   "driver's cache, in ours\n",
                   report.contextSeconds * 1e3)
            << tableText(startColumns, json.find("startUp")->find("simulations")->items);
    for (const JsonValue& passes : rows("passTimes"))
        out << concat("\npasses of ", passes.find("count")->text, " quads, ", passes.find("subject")->text,
                      ", ", passes.find("solver")->text, "; all calls of a frame, which takes ",
                      formatted("%.2f ms\n", passes.find("frameMinSeconds")->number * 1e3))
            << tableText(passColumns, passes.find("passes")->items);
    out << targetText(json, report.whole) << leftOutText(report.leftOut);
    if (const int count = disturbed(report.results))
        out << "\nIn " << count << " of " << report.results.size()
            << " cases the median is more than 1.3 times the shortest: something else was running. Measure "
               "again\n"
               "on a quiet machine before believing a ratio.\n";
    return out.str();
}

}  // namespace shoal::bench
