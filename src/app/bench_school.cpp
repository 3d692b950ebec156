// `shoal bench school`: fish that swim and school, steps a second by their number.
#include <iomanip>
#include <iostream>
#include <sstream>

#include "app/commands.h"
#include "app/machine.h"
#include "bench/bench.h"
#include "core/cache_folder.h"
#include "core/json.h"
#include "measure/timing.h"
#include "molecule/molecule_file.h"
#include "run/data_paths.h"
#include "run/progress.h"

namespace shoal::app {

using namespace bench;

namespace {

std::string asText(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    std::ostringstream out;
    out << asText(machine)
        << "\n\nFry of 20 vertices and 84 springs, leapfrog, 1/60 s a frame in 5 substeps, " << schoolDensity
        << " a cubic metre;\ntimes of a frame: min / median; steps a second by the minimum\n\n"
        << std::left << std::setw(30) << "" << std::right << std::setw(20) << "ms" << std::setw(12)
        << "steps/s" << std::setw(12) << "us a fish"
        << "\n";
    for (const SchoolTimes& times : all) {
        std::ostringstream frame;
        frame << std::fixed << std::setprecision(2) << times.frame.min * 1e3 << " / "
              << times.frame.median * 1e3;
        out << std::left << std::setw(30)
            << concat(times.one.count, times.one.schools ? " that school" : " that only swim") << std::right
            << std::setw(20) << frame.str() << std::fixed << std::setw(12) << std::setprecision(1)
            << 1 / times.frame.min << std::setw(12) << std::setprecision(3) << times.perFish() * 1e6 << "\n";
    }
    return out.str();
}

JsonValue asJson(const MeasuredOn& machine, const std::vector<SchoolTimes>& all) {
    JsonValue cases = JsonValue::makeArray();
    for (const SchoolTimes& times : all) {
        JsonValue entry = JsonValue::makeObject();
        entry.add("fish", JsonValue::makeNumber(times.one.count))
            .add("schools", JsonValue::makeBoolean(times.one.schools))
            .add("minSeconds", JsonValue::makeNumber(times.frame.min))
            .add("medianSeconds", JsonValue::makeNumber(times.frame.median))
            .add("samples", JsonValue::makeNumber(times.frame.samples));
        cases.items.push_back(std::move(entry));
    }
    JsonValue out = headOf(machine);
    out.add("cases", std::move(cases));
    return out;
}

}  // namespace

int benchSchoolCommand(const Options& options) {
    const Molecule fry = readMolecule(moleculeFolder() + "/fry.json");
    gpu::Context context(hiddenContext(options));
    gpu::ProgramCache cache(context, cacheFolder());
    MeasuredOn machine = measuredOn(context);
    const BenchDevice device{&context, shaderRoot(), &cache, {}, machine.cores, {}};
    const double seconds = options.seconds.value_or(options.quick ? 1 : 20);
    const std::vector<SchoolTimes> times = measureSchools(schoolCases(options.quick), fry, device, seconds);
    machine.pinned = measure::pinRasteriserThreads();
    tellWarnings(cache.takeWarnings());
    std::cout << (options.json ? writeJson(asJson(machine, times)) : asText(machine, times));
    return 0;
}

}  // namespace shoal::app
