// `shoal bench collide`: contact between molecules against a CPU baseline, and what each search finds.
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "core/data_paths.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

using namespace bench;

namespace {

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

void measureAll(const CollideCases& wanted, const Options& options, const BenchDevice& device,
                const measure::Schedule& schedule, CollideReport& report) {
    const std::string folder = moleculeFolder() + "/";
    const Molecule quad = readMolecule(folder + "quad.json"), point = readMolecule(folder + "point.json");
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

}  // namespace

int benchCollideCommand(const Options& options) {
    const CollideCases wanted = collideCasesOf(options.only);
    BenchSession session(options, 20, 2);
    CollideReport report;
    report.secondsAGroup = session.schedule.seconds;
    measureAll(wanted, options, session.device, session.schedule, report);
    session.end();
    report.machine = session.machine;
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
