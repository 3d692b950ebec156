// The report of `shoal measure`, as a table, JSON or CSV.
#pragma once

#include <optional>
#include <string>

#include "core/json.h"
#include "gpu/context.h"
#include "measure/accuracy.h"
#include "measure/calibrate.h"

namespace shoal::app {

struct MeasureReport {
    std::string processor;
    int cores = 1;
    gpu::ContextInfo context;
    measure::AccuracyReport accuracy;
    double target = 1e-3;                        // relative error
    std::optional<measure::Calibration> chosen;  // what the calibration takes for it
    std::string notChosen;                       // why there is none
};

// One point: what was chosen; null without.
const measure::AccuracyPoint* chosenPoint(const MeasureReport& report);

std::string asText(const MeasureReport& report);
JsonValue asJson(const MeasureReport& report);
// A row a point; the first names the columns.
std::string asCsv(const MeasureReport& report);

// A calibration as text, also for `explain`. measure/calibration_store.h writes it as JSON.
std::string asText(const measure::Calibration& calibration);
std::string oneLine(const measure::Calibration& calibration);

}  // namespace shoal::app
