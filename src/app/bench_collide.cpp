// `shoal bench collide`: contact between molecules against a CPU baseline, UberFlow's experiments, and what
// each search finds.
#include <iostream>

#include "app/bench.h"
#include "app/commands.h"
#include "molecule/molecule_file.h"
#include "run/data_paths.h"

namespace shoal::app {

using namespace bench;

namespace {

struct CollideCases {
    bool molecules = false, uberFlow = false, searches = false;
    int groups(bool quick) const {
        return int(molecules) + int(searches) + (uberFlow ? int(uberFlowSides(quick).size()) : 0);
    }
};

CollideCases collideCasesOf(const std::string& only) {
    const auto named = [&](const std::string& name) { return name.find(only) != std::string::npos; };
    const CollideCases out{named("molecules"), named("UberFlow"), named("searches")};
    if (!out.molecules && !out.uberFlow && !out.searches)
        throw Error(concat("--only: nothing has \"", only,
                           "\" in its name; there are \"molecules\", \"UberFlow\" and \"searches\""));
    return out;
}

void measureAll(const CollideCases& wanted, const Options& options, const BenchDevice& device,
                const measure::Schedule& schedule, CollideReport& report) {
    const std::string folder = moleculeFolder() + "/";
    const Molecule quad = readMolecule(folder + "quad.json"), point = readMolecule(folder + "point.json");
    WholeRun run(std::vector<double>(size_t(wanted.groups(options.quick)), report.secondsAGroup * 1.2 + 2));
    const auto progress = [&](double share) { run.tell(share); };
    if (wanted.molecules) {
        report.contact = measureContact(contactCases(options.quick), quad, device, schedule, progress);
        run.next();
    }
    for (const int side : wanted.uberFlow ? uberFlowSides(options.quick) : std::vector<int>()) {
        for (UberFlowTimes& times : measureUberFlow(side, point, device, schedule, progress))
            report.uberFlow.push_back(std::move(times));
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
