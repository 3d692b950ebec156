// Tables of many accuracy reports, as Markdown.
#pragma once

#include <string>
#include <vector>

#include "measure/accuracy.h"
#include "measure/calibrate.h"
#include "measure/report_scenes.h"

namespace shoal::measure {

// One scene of the report, measured.
struct ReportEntry {
    std::string molecule, motion;
    double stiffness = 0;
    AccuracyReport accuracy;            // points, chaotic
    std::optional<Calibration> chosen;  // without candidates
};

// Which solver is cheapest at `error` and how many times as fast as euler; a row a motion and molecule, a
// column a stiffness.
std::string speedUpTable(const std::vector<ReportEntry>& entries, double error);
// Nanoseconds per vertex and simulated second of every solver at `error`; a row a scene.
std::string costTable(const std::vector<ReportEntry>& entries, double error);
// The method and substeps that the calibration chooses for its error.
std::string chosenTable(const std::vector<ReportEntry>& entries);

}  // namespace shoal::measure
