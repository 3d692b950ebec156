// The reports of `shoal measure`, as tables, JSON or CSV, and what the commands that measure a scene share.
#pragma once

#include <optional>
#include <string>

#include "app/line/commands.h"
#include "app/line/options.h"
#include "bench/machine.h"
#include "gpu/context.h"
#include "measure/accuracy.h"
#include "measure/calibrate.h"

namespace shoal::app {

struct MeasureReport {
    bench::MeasuredOn machine;
    measure::AccuracyReport accuracy;
    double target = 1e-3;                        // relative error
    bool isTargetAsked = false;                  // by --error
    double vertices = 0;                         // of the scene
    std::optional<measure::Calibration> chosen;  // what the calibration takes for it
    std::string notChosen;                       // why there is none
};

// One point: what was chosen; null without.
const measure::AccuracyPoint* chosenPoint(const MeasureReport& report);

// The best methods at the end, and before them every point if `all`, or if nothing has an error.
std::string asText(const MeasureReport& report, bool all);
JsonValue asJson(const MeasureReport& report);
JsonValue firstKeys(const bench::MeasuredOn& machine);  // the first keys of what measure reports
// A row a point; the first names the columns.
std::string asCsv(const MeasureReport& report);

// A calibration as text, also for `explain`.
std::string asText(const measure::Calibration& calibration);
std::string oneLine(const measure::Calibration& calibration);

// Returns the options that --error, --solver, --substeps, --field-sampling and --duration ask for.
measure::CalibrationOptions calibrationOptions(const Options& options);
measure::AccuracyDevice accuracyDevice(const Options& options, gpu::Context& context);

// For --error: finds the method, puts it into the scene and compiles that; warnings go to standard error.
measure::Calibration calibrated(const Options& options, gpu::Context& context, Loaded& loaded);

int statisticsCommand(const Options& options);  // `shoal measure --statistics`
int contactCommand(const Options& options);     // `shoal measure --contact`

// Chooses and sweeps, with progress on standard error.
MeasureReport measureScene(const Scene& scene, const Options& options, const measure::AccuracyDevice& device);

}  // namespace shoal::app
