// Functions that the commands which measure a scene share.
#pragma once

#include "app/commands.h"
#include "app/measure_report.h"
#include "app/options.h"
#include "gpu/program_cache.h"

namespace shoal::app {

// Returns the options that --error, --solver, --substeps, --field-sampling and --duration ask for.
measure::CalibrationOptions calibrationOptions(const Options& options);
measure::AccuracyDevice accuracyDevice(const Options& options, gpu::Context& context,
                                       gpu::ProgramCache& cache);

// For --error: finds the method, puts it into the scene and compiles that; warnings go to standard error.
measure::Calibration calibrated(const Options& options, gpu::Context& context, Loaded& loaded);

// Chooses and sweeps, with progress on standard error.
MeasureReport measureScene(const Scene& scene, const Options& options, const measure::AccuracyDevice& device);

// `shoal measure --report`.
int measureReport(const Options& options);

}  // namespace shoal::app
