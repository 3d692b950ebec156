// `shoal bench sort`: the sorts in million items a second, beside what others published.
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"

namespace shoal::app {

using namespace bench;

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
    std::cout << (options.json ? writeJson(asJson(report)) : asText(report));
    return 0;
}

}  // namespace shoal::app
