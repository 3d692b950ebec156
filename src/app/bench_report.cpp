#include "app/bench_report.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <sstream>

namespace shoal::app {

using namespace measure;

namespace {

std::string number(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

// Three digits that count, without an exponent.
std::string short3(double value) {
    return number(value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

std::string orDash(const std::optional<double>& value) {
    return value ? short3(*value) : "-";
}

constexpr int labelWidth = 34;

void addRow(std::ostringstream& out, const std::vector<std::string>& cells) {
    static constexpr int widths[] = {labelWidth, 10, 11, 10, 10, 8, 8, 8, 8, 7};
    std::ostringstream line;
    for (size_t i = 0; i < cells.size(); ++i)
        line << (i == 0 ? std::left : std::right) << std::setw(widths[i]) << cells[i];
    const std::string text = line.str();
    out << text.substr(0, text.find_last_not_of(' ') + 1) << "\n";
}

void addResult(std::ostringstream& out, const BenchResult& result, const std::vector<BenchResult>& all) {
    const std::string label = "  " + result.one.label;
    if (!result.leftOut.empty()) {
        out << std::left << std::setw(labelWidth) << label << "   left out: " << result.leftOut << "\n";
        return;
    }
    const Ratios ratios = ratiosOf(result, all);
    const auto milliseconds = [](double seconds) { return number(seconds * 1e3, 3); };
    addRow(out, {label, milliseconds(result.frame.min), milliseconds(result.frame.median),
                 short3(result.perMolecule() * 1e9), orDash(ratios.avx512), orDash(ratios.avx2),
                 orDash(ratios.pingPong), number(double(result.stateBytes) / result.one.count, 0),
                 ratios.bandwidth ? short3(*ratios.bandwidth * 1e-9) : "-",
                 ratios.shareOfCopy ? number(*ratios.shareOfCopy * 100, 0) + "%" : "-"});
}

void addTimes(std::ostringstream& out, const std::vector<BenchResult>& results) {
    std::string group;
    for (const BenchResult& result : results) {
        if (result.one.group != group) {
            group = result.one.group;
            out << "\n";
            addRow(out, {group, "min ms", "median ms", "ns each", "/AVX-512", "/AVX2", "vs p-p", "bytes",
                         "GB/s", "copy"});
        }
        addResult(out, result, results);
    }
}

void addVerdicts(std::ostringstream& out, const std::vector<Target>& all) {
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
    list("These were not measured:", [](const Target& t) { return !t.measured; });
}

JsonValue orNull(const std::optional<double>& value) {
    return value ? JsonValue::makeNumber(*value) : JsonValue();
}

JsonValue asJson(const BenchResult& result, const std::vector<BenchResult>& all) {
    const BenchCase& one = result.one;
    JsonValue out = JsonValue::makeObject();
    out.add("group", JsonValue::makeString(one.group))
        .add("case", JsonValue::makeString(one.label))
        .add("subject", JsonValue::makeString(name(one.subject)))
        .add("molecule", JsonValue::makeString(one.molecule))
        .add("count", JsonValue::makeNumber(one.count));
    if (!result.leftOut.empty()) return out.add("leftOut", JsonValue::makeString(result.leftOut));
    if (!isCopy(one.subject)) {
        out.add("solver", JsonValue::makeString(shoal::name(one.solver)))
            .add("substeps", JsonValue::makeNumber(one.substeps))
            .add("wind", JsonValue::makeString(one.wind == Wind::uniform ? "uniform" : "gusts"));
    }
    if (isPath(one.subject)) {
        out.add("fieldSampling", JsonValue::makeString(shoal::name(one.sampling)))
            .add("lanes", JsonValue::makeString(shoal::name(result.lanes)))
            .add("inPlace", JsonValue::makeBoolean(one.inPlace))
            .add("drawn", JsonValue::makeBoolean(one.drawn));
    }
    const Ratios ratios = ratiosOf(result, all);
    out.add("samples", JsonValue::makeNumber(result.frame.samples))
        .add("framesPerSample", JsonValue::makeNumber(result.framesPerSample))
        .add("minSeconds", JsonValue::makeNumber(result.frame.min))
        .add("medianSeconds", JsonValue::makeNumber(result.frame.median))
        .add("nanosecondsPerMolecule", JsonValue::makeNumber(result.perMolecule() * 1e9))
        .add("overAvx512", orNull(ratios.avx512))
        .add("overAvx2", orNull(ratios.avx2))
        .add("fasterThanPingPong", orNull(ratios.pingPong))
        .add("stateBytesPerMolecule", JsonValue::makeNumber(double(result.stateBytes) / one.count))
        .add("movedBytesPerFrame",
             result.movedBytes ? JsonValue::makeNumber(double(result.movedBytes)) : JsonValue())
        .add("bytesPerSecond", orNull(ratios.bandwidth))
        .add("shareOfCopy", orNull(ratios.shareOfCopy))
        .add("busStateBytesPerFrame", JsonValue::makeNumber(result.busStateBytes));
    return out;
}

JsonValue asJson(const Target& target) {
    JsonValue out = JsonValue::makeObject();
    out.add("target", JsonValue::makeString(target.what))
        .add(target.atLeast ? "atLeast" : "atMost", JsonValue::makeNumber(target.limit))
        .add("measured", orNull(target.measured));
    if (target.measured) out.add("holds", JsonValue::makeBoolean(target.holds()));
    return out;
}

template <typename Items>
JsonValue arrayOf(const Items& items) {
    JsonValue out = JsonValue::makeArray();
    for (const auto& item : items)
        out.items.push_back(asJson(item));
    return out;
}

}  // namespace

std::string asText(const BenchReport& report) {
    std::ostringstream out;
    out << report.processor << ", " << report.cores << " cores\n"
        << report.context.renderer << " (" << gpu::name(report.context.kind) << "), OpenGL "
        << report.context.version << "\n"
        << "euler, 4 substeps a frame of 1/60 s unless a case says otherwise; pictures of " << report.width
        << " x " << report.height << ".\n"
        << "ns each: median by molecules. /AVX-512, /AVX2: times that yardstick. vs p-p: times as fast as\n"
        << "ping-pong. bytes: of state, each. copy: share of the fastest copy's bandwidth.\n";
    addTimes(out, report.results);
    addVerdicts(out, targets(report.results, report.context.software));
    return out.str();
}

JsonValue asJson(const BenchReport& report) {
    JsonValue machine = JsonValue::makeObject();
    machine.add("processor", JsonValue::makeString(report.processor))
        .add("cores", JsonValue::makeNumber(report.cores))
        .add("pinnedRasteriserThreads", JsonValue::makeNumber(report.pinned));
    JsonValue context = JsonValue::makeObject();
    context.add("kind", JsonValue::makeString(gpu::name(report.context.kind)))
        .add("renderer", JsonValue::makeString(report.context.renderer))
        .add("version", JsonValue::makeString(report.context.version))
        .add("software", JsonValue::makeBoolean(report.context.software));
    JsonValue cases = JsonValue::makeArray();
    for (const BenchResult& result : report.results)
        cases.items.push_back(asJson(result, report.results));
    JsonValue out = JsonValue::makeObject();
    out.add("version", JsonValue::makeString(SHOAL_VERSION))
        .add("machine", std::move(machine))
        .add("context", std::move(context))
        .add("quick", JsonValue::makeBoolean(report.quick))
        .add("secondsAGroup", JsonValue::makeNumber(report.secondsAGroup))
        .add("seconds", JsonValue::makeNumber(report.seconds))
        .add("cases", std::move(cases))
        .add("targets", arrayOf(targets(report.results, report.context.software)));
    return out;
}

}  // namespace shoal::app
