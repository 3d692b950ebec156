// `shoal bench` with a word: contact against a CPU baseline and what each search finds; point particles
// beside a loop on the CPU, a share of a quad and the papers; fish that school; the sorts beside what others
// published.
#include <algorithm>
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "core/data_paths.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

using namespace bench;

namespace {

Molecule shipped(const char* name) {
    return readMolecule(concat(moleculeFolder(), "/", name, ".json"));
}

template <typename... Report>
void print(const Options& options, const Report&... report) {
    std::cout << (options.json ? writeJson(asJson(report...)) : asText(report...));
}

struct CollideCases {
    bool molecules = false, searches = false;
};

CollideCases collideCasesOf(const std::string& only) {
    const auto named = [&](const std::string& name) { return name.find(only) != std::string::npos; };
    const CollideCases out{named("molecules"), named("searches")};
    if (!out.molecules && !out.searches)
        throw Error(concat("--only: nothing has \"", only,
                           "\" in its name; there are \"molecules\" and \"searches\""));
    return out;
}

void measureCollisions(const CollideCases& wanted, const Options& options, const BenchDevice& device,
                       const measure::Schedule& schedule, CollideReport& report) {
    const Molecule quad = shipped("quad"), point = shipped("point");
    WholeRun run(std::vector<double>(size_t(wanted.molecules) + size_t(wanted.searches),
                                     report.secondsAGroup * 1.2 + 2));
    const auto progress = [&](double share) { run.tell(share); };
    if (wanted.molecules) {
        report.contact = measureContact(contactCases(options.quick), quad, device, schedule, progress);
        run.next();
    }
    if (wanted.searches) {
        report.searches = measureSearches(point, options.quick, device, schedule, progress);
        run.next();
    }
    run.end();
}

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

int benchCollideCommand(const Options& options) {
    const CollideCases wanted = collideCasesOf(options.only);
    BenchSession session(options, 20, 2);
    CollideReport report;
    report.secondsAGroup = session.schedule.seconds;
    measureCollisions(wanted, options, session.device, session.schedule, report);
    session.end();
    report.machine = session.machine;
    print(options, report);
    return 0;
}

int benchParticlesCommand(const Options& options) {
    const std::vector<std::vector<ParticleCase>> groups = byGroup(particleCasesOf(options));
    const Molecule quad = shipped("quad"), point = shipped("point");
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
    print(options, report);
    return 0;
}

int benchSchoolCommand(const Options& options) {
    const Molecule fry = shipped("fry");
    BenchSession session(options, 20, 1);
    const std::vector<SchoolTimes> times = measureSchools(
        schoolCases(options.quick, session.machine.context.software), fry, session.device, session.schedule);
    session.end();
    print(options, session.machine, times);
    return 0;
}

int benchSortCommand(const Options& options) {
    BenchSession session(options, 8, 1);
    SortReport report;
    report.machine = session.machine;
    report.machine.pinned = measure::pinRasteriserThreads();
    report.secondsASize = session.schedule.seconds;
    std::vector<int> sides = {128, 256, 512, SortTable::mostOfAll, 4096};
    if (options.quick) sides.resize(2);
    std::cerr << "This takes about " << roughly(double(sides.size()) * (report.secondsASize + 1)) << ".\n";
    Progress progress("sizes", int(sides.size()));
    for (const int side : sides) {
        report.tables.push_back(measureSorts(side, session.device, session.schedule));
        progress.step();
    }
    session.end();
    print(options, report);
    return 0;
}

}  // namespace shoal::app
