// Calibrations on disk: <folder>/calibrations/<key>.json.
#pragma once

#include <optional>
#include <string>

#include "compile/plan.h"
#include "core/json.h"
#include "measure/calibrate.h"

namespace shoal::measure {

// 16 hexadecimal digits of everything that a calibration depends on. `plan`: of the scene, with a solver that
// takes every step.
std::string calibrationKey(const Plan& plan, const CalibrationOptions& options, const AccuracyDevice& device);

// Nothing where there is none, or none that can be read: it is measured anew.
std::optional<Calibration> loadCalibration(const std::string& folder, const std::string& key);
// Does nothing without a folder. A disk that is full, or a folder that cannot be made, is no mistake of the
// user's: the next run measures again.
void keepCalibration(const std::string& folder, const std::string& key, const Calibration& calibration);

JsonValue asJson(const Calibration& calibration);

}  // namespace shoal::measure
