#include "bench/reports.h"

namespace shoal::bench {

namespace {

JsonValue asJson(const BenchResult& result, const std::vector<BenchResult>& all) {
    const BenchCase& benchCase = result.benchCase;
    JsonValue out = object(key("group", benchCase.group), key("case", benchCase.label),
                           key("subject", name(benchCase.subject)), key("molecule", benchCase.molecule),
                           key("count", benchCase.count));
    if (!result.leftOut.empty()) return append(out, key("leftOut", result.leftOut));
    if (!result.failed.empty()) return append(out, key("failed", result.failed));
    if (!isCopy(benchCase.subject))
        append(out, key("solver", shoal::name(benchCase.solver)), key("substeps", benchCase.substeps),
               key("wind", name(benchCase.wind)));
    if (isPath(benchCase.subject))
        append(out, key("fieldSampling", shoal::name(benchCase.sampling)),
               key("lanes", shoal::name(result.lanes)), key("inPlace", benchCase.inPlace),
               key("drawn", benchCase.drawn));
    std::optional<double> each, moved;
    if (benchCase.subject != Subject::multiplyAdd) each = result.perMolecule() * 1e9;
    if (result.movedBytes > 0) moved = double(result.movedBytes);
    const Ratios ratios = ratiosOf(result, all);
    append(out, key("samples", result.frame.samples), key("framesPerSample", result.framesPerSample),
           key("minSeconds", result.frame.min), key("medianSeconds", result.frame.median));
    appendDeviceTime(out, result.device);
    return append(out, key("nanosecondsPerMolecule", each), key("overAvx512", ratios.avx512),
                  key("overAvx2", ratios.avx2), key("fasterThanPingPong", ratios.pingPong),
                  key("stateBytesPerMolecule", double(result.stateBytes) / benchCase.count),
                  key("movedBytesPerFrame", moved), key("bytesPerSecond", ratios.bandwidth),
                  key("shareOfCopy", ratios.shareOfCopy), key("operationsPerSecond", ratios.arithmetic),
                  key("shareOfPeak", ratios.shareOfPeak), key("busStateBytesPerFrame", result.busStateBytes));
}

JsonValue wantedAndMeasured(const Target& target) {
    return object(key("target", target.what), key(target.atLeast ? "atLeast" : "atMost", target.limit),
                  key("measured", target.measured));
}

JsonValue asJson(const Target& target) {
    JsonValue out = wantedAndMeasured(target);
    if (target.ofMedians) append(out, key("ofMedians", *target.ofMedians));
    if (target.measured) append(out, key("holds", target.holds()));
    return out;
}

JsonValue asJson(const BenchError& error, const std::vector<BenchResult>& all) {
    JsonValue out = object(key("subject", name(error.subject)), key("solver", shoal::name(error.solver)),
                           key("wind", name(error.wind)), key("fieldSampling", shoal::name(error.sampling)),
                           key("relativeError", error.relative));
    for (const int count : {16384, 131072})
        if (const BenchResult* speed = speedOf(error, count, all))
            out.add("nanosecondsPerMolecule" + std::to_string(count), toJson(speed->perMolecule() * 1e9));
    return out;
}

JsonValue asJson(const StartTime& start) {
    return object(key("molecule", start.molecule), key("count", start.count),
                  key("solver", shoal::name(start.solver)), key("planSeconds", start.compile),
                  key("coldSeconds", start.cold), key("driverCacheSeconds", start.driver),
                  key("programCacheSeconds", start.cached));
}

JsonValue asJson(const PassTable& table) {
    return object(key("molecule", "quad"), key("count", table.count), key("subject", name(table.subject)),
                  key("solver", shoal::name(table.solver)), key("frameMinSeconds", table.frame.min),
                  key("frameMedianSeconds", table.frame.median),
                  key("passes", arrayOf(table.passes, bench::asJson)));
}

}  // namespace

JsonValue asJson(const std::vector<Target>& targets) {
    return arrayOf(targets, wantedAndMeasured);
}

JsonValue asJson(const BenchReport& report) {
    const JsonValue machine =
        object(key("processor", report.machine.processor), key("cores", report.machine.cores),
               key("pinnedRasteriserThreads", report.machine.pinned));
    JsonValue cases = JsonValue::makeArray(), errors = JsonValue::makeArray();
    for (const BenchResult& result : report.results)
        cases.items.push_back(asJson(result, report.results));
    for (const BenchError& error : report.errors)
        errors.items.push_back(asJson(error, report.results));
    const JsonValue start = object(key("contextSeconds", report.contextSeconds),
                                   key("simulations", arrayOf(report.starts, asJson)));
    return object(key("version", report.machine.version), key("machine", machine),
                  key("context", asJson(report.machine.context)), key("quick", report.quick),
                  key("pictureSize", concat(pictureWidth, "x", pictureHeight)),
                  key("secondsAGroup", report.secondsAGroup), key("seconds", report.seconds),
                  key("leftOut", report.leftOut), key("cases", cases), key("errors", errors),
                  key("startUp", start), key("passTimes", arrayOf(report.passes, asJson)),
                  key("disturbedCases", disturbed(report.results)),
                  key("targets", arrayOf(targets(report.results, report.machine.context.software), asJson)));
}

}  // namespace shoal::bench
