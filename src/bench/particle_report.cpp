#include "bench/reports.h"

#include <algorithm>
#include <optional>

#include "core/table.h"

namespace shoal::bench {

namespace {

using What = ParticleCase::What;

using Times = std::vector<ParticleTimes>;

template <typename Which>
const ParticleTimes* find(const Times& times, Which which) {
    const auto found = std::find_if(times.begin(), times.end(), [&](const ParticleTimes& t) {
        return t.leftOut.empty() && which(t.benchCase);
    });
    return found == times.end() ? nullptr : &*found;
}

int largestSide(const Times& times) {
    int out = 0;
    for (const ParticleTimes& t : times)
        out = std::max(out, t.benchCase.side);
    return out;
}

void addShares(const Times& times, std::vector<Target>& out) {
    for (const ParticleTimes& quads : times) {
        if (!quads.benchCase.quads || !quads.leftOut.empty()) continue;
        const ParticleTimes* points = find(times, [&](const ParticleCase& particleCase) {
            return particleCase.group == quads.benchCase.group && !particleCase.quads;
        });
        if (points)
            out.push_back({"a point over its " + quads.benchCase.group, 1.5, false,
                           points->frame.min / quads.frame.min});
    }
}

void addBirths(const Times& times, std::vector<Target>& out) {
    for (const ParticleTimes& t : times) {
        if (!t.benchCase.allocator || !t.leftOut.empty()) continue;
        if (*t.benchCase.allocator == Allocator::heap)
            out.push_back({"heap: places up to the last taken, over the living; " + t.benchCase.group, 1.05,
                           false, t.packing});
        if (*t.benchCase.allocator == Allocator::gpu)
            out.push_back({"gpu: bytes over the bus a frame; " + t.benchCase.group, 0, false, t.busBytes});
    }
}

// Ratios and rates of the shortest times.
std::vector<Target> targets(const ParticleReport& report) {
    std::vector<Target> out;
    addShares(report.times, out);
    const int side = largestSide(report.times);
    const auto step = find(report.times, [&](const ParticleCase& particleCase) {
        return particleCase.heights && particleCase.side == side && particleCase.what == What::step &&
               !particleCase.quads && particleCase.frameRate == 60 &&
               particleCase.solver == SolverKind::leapfrog && !particleCase.inPlace;
    });
    const std::string what = concat("steps a second of ", grouped(side * side), " over a height field");
    out.push_back({what, 100, true, step ? std::optional(1 / step->frame.min) : std::nullopt});
    const auto copy = find(report.times, [&](const ParticleCase& particleCase) {
        return particleCase.heights && particleCase.side == side && particleCase.what == What::copy;
    });
    if (!report.machine.context.software && step && copy)
        out.push_back({"a step over a height field, over a copy of the state", 2, false,
                       step->frame.min / copy->frame.min});
    addBirths(report.times, out);
    return out;
}

// ns: what births and deaths add, by the slope between two turnovers of one size.
struct BirthCost {
    std::string how;
    int side = 0;
    double nanoseconds = 0;
};

std::vector<BirthCost> birthCosts(const Times& times) {
    std::vector<BirthCost> out;
    for (const ParticleTimes& many : times) {
        if (many.benchCase.turnover < 0.1 || !many.leftOut.empty()) continue;
        const ParticleTimes* few = find(times, [&](const ParticleCase& particleCase) {
            return particleCase.side == many.benchCase.side && particleCase.label == many.benchCase.label &&
                   particleCase.turnover > 0 && particleCase.turnover < many.benchCase.turnover;
        });
        if (!few) continue;
        const double more = (many.benchCase.turnover - few->benchCase.turnover) * many.benchCase.count();
        out.push_back(
            {many.benchCase.label, many.benchCase.side, (many.frame.min - few->frame.min) * 1e9 / more});
    }
    return out;
}

constexpr Column particleColumns[] = {{"case", "case", -40},
                                      {"minSeconds", "min ms", 9, "%.3f", 1e3},
                                      {"medianSeconds", "median ms", 11, "%.3f", 1e3},
                                      {"deviceMinSeconds", "device ms", 11, "%.3f", 1e3},
                                      {"", "steps/s", 10, "%.0f", 1, "minSeconds"},
                                      {"nanosecondsPerParticle", "ns each", 9},
                                      {"movedBytesPerFrame", "GB/s", 8, "%.1f", 1e-9, "minSeconds"},
                                      {"positionError", "error m", 10, "%.1e"},
                                      {"publishedFramesPerSecond", "UberFlow", 10, "%g"}};
// Of a frame; packing: places up to the last that is taken, over the living.
constexpr Column birthColumns[] = {{"case", "case", -40},
                                   {"living", "living", 10, "%.0f"},
                                   {"bornPerFrame", "born", 9, "%.0f"},
                                   {"lostPerFrame", "lost", 9, "%.1f"},
                                   {"packing", "packing", 9, "%.3f"},
                                   {"busBytesPerFrame", "bus bytes", 11, "%.0f"}};
constexpr Column costColumns[] = {
    {"case", "a birth and a death", -40}, {"side", "side", 10, "%.0f"}, {"nanoseconds", "ns", 9, "%.1f"}};

std::optional<double> unlessZero(double value) {
    return value > 0 ? std::optional(value) : std::nullopt;
}

JsonValue asJson(const ParticleTimes& t) {
    JsonValue out = object(key("group", t.benchCase.group), key("case", t.benchCase.label),
                           key("side", t.benchCase.side));
    if (!t.leftOut.empty()) return append(out, key("leftOut", t.leftOut));
    append(out, key("solver", name(t.benchCase.solver)), key("substeps", t.benchCase.substeps),
           key("minSeconds", t.frame.min), key("medianSeconds", t.frame.median),
           key("samples", t.frame.samples), key("nanosecondsPerParticle", t.perParticle() * 1e9),
           key("movedBytesPerFrame", unlessZero(double(t.movedBytes))), key("busBytesPerFrame", t.busBytes),
           key("positionError", t.error), key("publishedFramesPerSecond", unlessZero(t.benchCase.published)));
    appendDeviceTime(out, t.device);
    if (t.benchCase.allocator)
        append(out, key("allocator", name(*t.benchCase.allocator)), key("turnover", t.benchCase.turnover),
               key("living", t.live), key("bornPerFrame", t.born), key("lostPerFrame", t.lost),
               key("packing", t.packing));
    return out;
}

JsonValue asJson(const BirthCost& cost) {
    return object(key("case", cost.how), key("side", cost.side), key("nanoseconds", cost.nanoseconds));
}

constexpr const char* papers =
    "UberFlow: frames a second with drawing, table 2 ([Kipfer 2004]; ATI Radeon 9800 Pro,\n"
    "  Pentium 4 of 2 GHz; its loop on the CPU stands beside std::sort).\n"
    "[Latta 2004, section 4] states no times: 1024 x 1024 particles \"in real-time only with few effects "
    "and\n"
    "  without sorting\", 512 x 512 with all of them, on the first graphics cards with floating point.\n";

}  // namespace

std::string asText(const ParticleReport& report) {
    const JsonValue json = asJson(report);
    const std::vector<JsonValue>&cases = json.find("cases")->items, &costs = json.find("birthCosts")->items;
    std::vector<JsonValue> births;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(births),
                 [](const JsonValue& row) { return row.find("allocator"); });
    return asText(report.machine) + "\n" + tableText(particleColumns, cases, "group") +
           tableText(birthColumns, births, "group") + (costs.empty() ? "" : "\n") +
           tableText(costColumns, costs) + "\n" + papers + targetText(json) + leftOutText(report.leftOut);
}

JsonValue asJson(const ParticleReport& report) {
    JsonValue out = headOf(report.machine);
    return append(out, key("secondsAGroup", report.secondsAGroup), key("leftOut", report.leftOut),
                  key("cases", arrayOf(report.times, asJson)),
                  key("birthCosts", arrayOf(birthCosts(report.times), asJson)),
                  key("targets", asJson(targets(report))));
}

}  // namespace shoal::bench
