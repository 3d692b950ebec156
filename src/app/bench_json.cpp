#include "app/bench.h"
#include "app/report.h"

namespace shoal::app {

using namespace bench;

namespace {

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
            .add("wind", JsonValue::makeString(name(one.wind)));
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
        .add("nanosecondsPerMolecule", one.subject == Subject::multiplyAdd
                                           ? JsonValue()
                                           : JsonValue::makeNumber(result.perMolecule() * 1e9))
        .add("overAvx512", orNull(ratios.avx512))
        .add("overAvx2", orNull(ratios.avx2))
        .add("fasterThanPingPong", orNull(ratios.pingPong))
        .add("stateBytesPerMolecule", JsonValue::makeNumber(double(result.stateBytes) / one.count))
        .add("movedBytesPerFrame",
             result.movedBytes ? JsonValue::makeNumber(double(result.movedBytes)) : JsonValue())
        .add("bytesPerSecond", orNull(ratios.bandwidth))
        .add("shareOfCopy", orNull(ratios.shareOfCopy))
        .add("operationsPerSecond", orNull(ratios.arithmetic))
        .add("shareOfPeak", orNull(ratios.shareOfPeak))
        .add("busStateBytesPerFrame", JsonValue::makeNumber(result.busStateBytes));
    return out;
}

JsonValue wantedAndMeasured(const Target& target) {
    JsonValue out = JsonValue::makeObject();
    return out.add("target", JsonValue::makeString(target.what))
        .add(target.atLeast ? "atLeast" : "atMost", JsonValue::makeNumber(target.limit))
        .add("measured", orNull(target.measured));
}

JsonValue asJson(const Target& target) {
    JsonValue out = wantedAndMeasured(target);
    if (target.ofMedians) out.add("ofMedians", JsonValue::makeNumber(*target.ofMedians));
    if (target.measured) out.add("holds", JsonValue::makeBoolean(target.holds()));
    return out;
}

JsonValue asJson(const BenchError& error, const std::vector<BenchResult>& all) {
    JsonValue out = JsonValue::makeObject();
    out.add("subject", JsonValue::makeString(name(error.subject)))
        .add("solver", JsonValue::makeString(shoal::name(error.solver)))
        .add("wind", JsonValue::makeString(name(error.wind)))
        .add("fieldSampling", JsonValue::makeString(shoal::name(error.sampling)))
        .add("relativeError", orNull(error.relative));
    for (const int count : {16384, 131072})
        if (const BenchResult* speed = speedOf(error, count, all))
            out.add("nanosecondsPerMolecule" + std::to_string(count),
                    JsonValue::makeNumber(speed->perMolecule() * 1e9));
    return out;
}

JsonValue asJson(const StartTime& start) {
    JsonValue out = JsonValue::makeObject();
    out.add("molecule", JsonValue::makeString(start.molecule))
        .add("count", JsonValue::makeNumber(start.count))
        .add("solver", JsonValue::makeString(shoal::name(start.solver)))
        .add("planSeconds", JsonValue::makeNumber(start.compile))
        .add("coldSeconds", JsonValue::makeNumber(start.cold))
        .add("driverCacheSeconds", JsonValue::makeNumber(start.driver))
        .add("programCacheSeconds", JsonValue::makeNumber(start.cached));
    return out;
}

JsonValue asJson(const PassTable& table) {
    JsonValue out = JsonValue::makeObject();
    out.add("molecule", JsonValue::makeString("quad"))
        .add("count", JsonValue::makeNumber(table.count))
        .add("subject", JsonValue::makeString(name(table.subject)))
        .add("solver", JsonValue::makeString(shoal::name(table.solver)))
        .add("frameMinSeconds", JsonValue::makeNumber(table.frame.min))
        .add("frameMedianSeconds", JsonValue::makeNumber(table.frame.median))
        .add("passes", app::asJson(table.passes));
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

JsonValue asJson(const std::vector<Target>& targets) {
    JsonValue out = JsonValue::makeArray();
    for (const Target& target : targets)
        out.items.push_back(wantedAndMeasured(target));
    return out;
}

JsonValue asJson(const BenchReport& report) {
    JsonValue machine = JsonValue::makeObject();
    machine.add("processor", JsonValue::makeString(report.machine.processor))
        .add("cores", JsonValue::makeNumber(report.machine.cores))
        .add("pinnedRasteriserThreads", JsonValue::makeNumber(report.machine.pinned));
    JsonValue cases = JsonValue::makeArray();
    for (const BenchResult& result : report.results)
        cases.items.push_back(asJson(result, report.results));
    JsonValue errors = JsonValue::makeArray();
    for (const BenchError& error : report.errors)
        errors.items.push_back(asJson(error, report.results));
    JsonValue start = JsonValue::makeObject();
    start.add("contextSeconds", JsonValue::makeNumber(report.contextSeconds))
        .add("simulations", arrayOf(report.starts));
    JsonValue out = JsonValue::makeObject();
    out.add("version", JsonValue::makeString(SHOAL_VERSION))
        .add("machine", std::move(machine))
        .add("context", asJson(report.machine.context))
        .add("quick", JsonValue::makeBoolean(report.quick))
        .add("pictureSize", JsonValue::makeString(concat(report.width, "x", report.height)))
        .add("secondsAGroup", JsonValue::makeNumber(report.secondsAGroup))
        .add("seconds", JsonValue::makeNumber(report.seconds))
        .add("cases", std::move(cases))
        .add("errors", std::move(errors))
        .add("startUp", std::move(start))
        .add("passTimes", arrayOf(report.passes))
        .add("disturbedCases", JsonValue::makeNumber(disturbed(report.results)))
        .add("targets", arrayOf(targets(report.results, report.machine.context.software)));
    return out;
}

}  // namespace shoal::app
