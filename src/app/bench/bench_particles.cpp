// `shoal bench particles`: point particles beside a loop on the CPU, a quad's share and the papers.
#include <algorithm>
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "core/data_paths.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

using namespace bench;

namespace {

std::vector<ParticleCase> particleCasesOf(const Options& options) {
    std::vector<ParticleCase> all = particleCases(options.quick), some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some), [&](const ParticleCase& particleCase) {
        return particleCase.name().find(options.only) != std::string::npos;
    });
    if (!some.empty()) return some;
    std::vector<std::string> names;
    for (const std::vector<ParticleCase>& group : byGroup(all))
        names.push_back(concat("\"", group.front().group, "\""));
    throw Error(
        concat("--only: nothing has \"", options.only, "\" in its name; there are ", joined(names, ", ")));
}

}  // namespace

int benchParticlesCommand(const Options& options) {
    const std::vector<std::vector<ParticleCase>> groups = byGroup(particleCasesOf(options));
    const std::string folder = moleculeFolder() + "/";
    const Molecule quad = readMolecule(folder + "quad.json"), point = readMolecule(folder + "point.json");
    BenchSession session(options, 8, 1);
    ParticleReport report;
    report.secondsAGroup = session.schedule.seconds;
    WholeRun run(std::vector<double>(groups.size(), report.secondsAGroup * 1.2 + 3), session.mostSeconds);
    for (const std::vector<ParticleCase>& group : groups) {
        if (!run.fits()) {
            report.leftOut.push_back(group.front().group);
            run.leaveOut();
            continue;
        }
        for (ParticleTimes& times : measureParticles(group, point, quad, session.device, session.schedule))
            report.times.push_back(std::move(times));
        run.tell(1);
        run.next();
    }
    run.end();
    session.end();
    report.machine = session.machine;
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
