// `shoal bench school`: fish that swim and school, steps a second by their number.
#include <iostream>

#include "app/bench/bench.h"
#include "app/line/commands.h"
#include "core/data_paths.h"
#include "molecule/molecule_file.h"

namespace shoal::app {

using namespace bench;

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
