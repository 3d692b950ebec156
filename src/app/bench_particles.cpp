// `shoal bench particles`: point particles beside a loop on the CPU, a quad's share and the papers.
#include <algorithm>
#include <iostream>

#include "app/bench.h"
#include "app/commands.h"
#include "core/cache_folder.h"
#include "measure/timing.h"
#include "molecule/molecule_file.h"
#include "run/data_paths.h"
#include "run/progress.h"

namespace shoal::app {

using namespace bench;

namespace {

std::vector<std::vector<ParticleCase>> byGroup(const std::vector<ParticleCase>& cases) {
    std::vector<std::vector<ParticleCase>> out;
    for (const ParticleCase& one : cases) {
        if (out.empty() || out.back().front().group != one.group) out.emplace_back();
        out.back().push_back(one);
    }
    return out;
}

std::vector<ParticleCase> wantedOf(const Options& options) {
    std::vector<ParticleCase> all = particleCases(options.quick), some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some),
                 [&](const ParticleCase& one) { return one.name().find(options.only) != std::string::npos; });
    if (!some.empty()) return some;
    std::string names;
    for (const std::vector<ParticleCase>& group : byGroup(all))
        names += concat(names.empty() ? "" : ", ", "\"", group.front().group, "\"");
    throw Error(concat("--only: nothing has \"", options.only, "\" in its name; there are ", names));
}

}  // namespace

int benchParticlesCommand(const Options& options) {
    const std::vector<std::vector<ParticleCase>> groups = byGroup(wantedOf(options));
    const std::string folder = moleculeFolder() + "/";
    const Molecule quad = readMolecule(folder + "quad.json"), point = readMolecule(folder + "point.json");
    gpu::Context context(hiddenContext(options));
    gpu::ProgramCache cache(context, cacheFolder());
    ParticleReport report;
    report.machine = measuredOn(context);
    report.secondsAGroup = options.seconds.value_or(options.quick ? 1 : 8);
    const BenchDevice device{&context, shaderRoot(), &cache, drawMaker(context), report.machine.cores, {}};
    std::cerr << "This takes about " << roughly(double(groups.size()) * (report.secondsAGroup * 1.2 + 3))
              << ".\n";
    measure::Schedule schedule;
    schedule.seconds = report.secondsAGroup;
    Progress bar("groups", int(groups.size()));
    for (const std::vector<ParticleCase>& group : groups) {
        for (ParticleTimes& times : measureParticles(group, point, quad, device, schedule))
            report.times.push_back(std::move(times));
        bar.step();
    }
    report.machine.pinned = measure::pinRasteriserThreads();  // all of them run by now
    tellWarnings(cache.takeWarnings());
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
