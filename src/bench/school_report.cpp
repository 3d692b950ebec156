#include "bench/reports.h"
#include "core/table.h"

namespace shoal::bench {

namespace {

constexpr Column schoolColumns[] = {{"fish", "fish", 7, "%.0f"},
                                    {"schools", "school", 8},
                                    {"path", "path", 11},
                                    {"minSeconds", "min ms", 10, "%.2f", 1e3},
                                    {"medianSeconds", "median ms", 11, "%.2f", 1e3},
                                    {"deviceMinSeconds", "device ms", 11, "%.3f", 1e3},
                                    {"", "steps/s", 10, "%.1f", 1, "minSeconds"},
                                    {"minSeconds", "us a fish", 11, "%.3f", 1e6, "fish"}};

JsonValue asJson(const SchoolTimes& times) {
    JsonValue out = object(key("fish", times.benchCase.count), key("schools", times.benchCase.schools),
                           key("path", name(times.benchCase.path)));
    if (!times.leftOut.empty()) return append(out, key("leftOut", times.leftOut));
    append(out, key("minSeconds", times.frame.min), key("medianSeconds", times.frame.median),
           key("samples", times.frame.samples));
    appendDeviceTime(out, times.device);
    return out;
}

}  // namespace

JsonValue asJson(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    JsonValue out = headOf(machine);
    return append(out, key("cases", arrayOf(all, asJson)));
}

std::string asText(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    return concat(asText(machine),
                  "\n\nFry of 20 vertices and 84 springs, leapfrog, 1/60 s a frame in 5 substeps, ",
                  schoolDensity, " a cubic metre\n\n",
                  tableText(schoolColumns, asJson(machine, all).find("cases")->items));
}

}  // namespace shoal::bench
