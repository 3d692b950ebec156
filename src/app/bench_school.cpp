// `shoal bench school`: fish that swim and school, steps a second by their number.
#include <iostream>

#include "app/bench.h"
#include "app/commands.h"
#include "molecule/molecule_file.h"
#include "run/data_paths.h"

namespace shoal::app {

using namespace bench;

namespace {

std::string asText(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    std::string out = concat(
        asText(machine), "\n\nFry of 20 vertices and 84 springs, leapfrog, 1/60 s a frame in 5 substeps, ",
        schoolDensity,
        " a cubic metre;\ntimes of a frame: min / median, and the device's own, the shortest; steps a second "
        "by the minimum\n\n");
    out += formatted("%-30s%20s%12s%12s%12s\n", "", "ms", "device ms", "steps/s", "us a fish");
    for (const SchoolTimes& times : all) {
        out += formatted("%-30s", concat(times.benchCase.count,
                                         times.benchCase.schools ? " that school" : " that only swim",
                                         times.benchCase.path == Path::fragments ? ", in fragments" : "")
                                      .c_str());
        if (!times.leftOut.empty())
            out += concat("left out: ", times.leftOut, "\n");
        else
            out += formatted(
                "%20s%12s%12.1f%12.3f\n",
                formatted("%.2f / %.2f", times.frame.min * 1e3, times.frame.median * 1e3).c_str(),
                deviceMilliseconds(times.device).c_str(), 1 / times.frame.min, times.perFish() * 1e6);
    }
    return out;
}

JsonValue asJson(const SchoolTimes& times) {
    JsonValue out = object(key("fish", times.benchCase.count), key("schools", times.benchCase.schools),
                           key("path", name(times.benchCase.path)));
    if (!times.leftOut.empty()) return append(out, key("leftOut", times.leftOut));
    append(out, key("minSeconds", times.frame.min), key("medianSeconds", times.frame.median),
           key("samples", times.frame.samples));
    appendDeviceTime(out, times.device);
    return out;
}

JsonValue asJson(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    JsonValue out = headOf(machine);
    return append(out, key("cases", arrayOf(all, asJson)));
}

}  // namespace

int benchSchoolCommand(const Options& options) {
    const Molecule fry = readMolecule(moleculeFolder() + "/fry.json");
    BenchSession session(options, 20, 1);
    const std::vector<SchoolTimes> times = measureSchools(
        schoolCases(options.quick, session.machine.context.software), fry, session.device, session.schedule);
    session.end();
    std::cout << (options.json ? writeJson(asJson(session.machine, times)) : asText(session.machine, times));
    return 0;
}

}  // namespace shoal::app
