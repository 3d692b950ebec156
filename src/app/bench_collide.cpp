// `shoal bench collide`: contact between molecules against a CPU baseline, UberFlow's experiments, and what
// each search finds.
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

struct Wanted {
    bool molecules = false, uberFlow = false, searches = false;
    int groups(bool quick) const {
        return int(molecules) + int(searches) + (uberFlow ? int(uberFlowSides(quick).size()) : 0);
    }
};

Wanted wantedOf(const std::string& only) {
    const auto named = [&](const std::string& name) { return name.find(only) != std::string::npos; };
    const Wanted out{named("molecules"), named("UberFlow"), named("searches")};
    if (!out.molecules && !out.uberFlow && !out.searches)
        throw Error(concat("--only: nothing has \"", only,
                           "\" in its name; there are \"molecules\", \"UberFlow\" and \"searches\""));
    return out;
}

// One bar for groups that take about as long.
class Bar {
  public:
    explicit Bar(int groups) : groups_(groups) {}
    void tell(double share) { show(int(100 * (done_ + share) / groups_)); }
    void next() {
        ++done_;
        tell(0);
    }

  private:
    void show(int percent) {
        for (; shown_ < std::min(percent, 100); ++shown_)
            progress_.step();
    }
    int groups_, done_ = 0, shown_ = 0;
    Progress progress_{"per cent", 100};
};

void measureAll(const Wanted& wanted, const Options& options, const BenchDevice& device,
                CollideReport& report) {
    const std::string folder = moleculeFolder() + "/";
    const Molecule quad = readMolecule(folder + "quad.json"), point = readMolecule(folder + "point.json");
    const int groups = wanted.groups(options.quick);
    std::cerr << "This takes about " << roughly(groups * (report.secondsAGroup * 1.2 + 2)) << ".\n";
    measure::Schedule schedule;
    schedule.seconds = report.secondsAGroup;
    Bar bar(groups);
    const auto progress = [&](double share) { bar.tell(share); };
    if (wanted.molecules) {
        report.contact = measureContact(contactCases(options.quick), quad, device, schedule, progress);
        bar.next();
    }
    for (const int side : wanted.uberFlow ? uberFlowSides(options.quick) : std::vector<int>()) {
        for (UberFlowTimes& times : measureUberFlow(side, point, device, schedule, progress))
            report.uberFlow.push_back(std::move(times));
        bar.next();
    }
    if (wanted.searches) {
        report.searches = measureSearches(point, options.quick, device, schedule, progress);
        bar.next();
    }
}

}  // namespace

int benchCollideCommand(const Options& options) {
    const Wanted wanted = wantedOf(options.only);
    gpu::Context context(hiddenContext(options));
    gpu::ProgramCache cache(context, cacheFolder());
    CollideReport report;
    report.machine = measuredOn(context);
    report.secondsAGroup = options.seconds.value_or(options.quick ? 2 : 20);
    const BenchDevice device{&context, shaderRoot(), &cache, drawMaker(context), report.machine.cores, {}};
    measureAll(wanted, options, device, report);
    report.machine.pinned = measure::pinRasteriserThreads();  // all of them run by now
    tellWarnings(cache.takeWarnings());
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
