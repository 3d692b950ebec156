// Reads what `shoal measure --json` wrote, so that a report goes on where it was ended.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "measure/accuracy_tables.h"

namespace shoal::app {

// Where and how a scene was measured: what is measured again where it differs.
struct MeasuredWith {
    std::string processor, renderer, context, opengl;
    int cores = 1;
    std::string path;  // "fused"; empty: any
    std::string scene;
    double frameRate = 60, duration = 1;
    double target = 1e-3;
    std::vector<std::pair<int, int>> molecules;  // of each group: measured, timed
    std::vector<std::pair<int, int>> shapes;     // of each group: vertices, springs
    std::set<std::string> solvers, samplings;
};

struct Measured {
    measure::ReportEntry entry;
    MeasuredWith with;
};

// The points, why there are no errors, and what was chosen (without candidates). Nothing: there is no such
// file, or none of this version.
std::optional<Measured> readMeasured(const std::string& file);

// The first thing that differs, as "the processor"; empty: nothing.
std::string difference(const MeasuredWith& found, const MeasuredWith& wanted);

}  // namespace shoal::app
