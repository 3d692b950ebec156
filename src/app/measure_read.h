// What `shoal measure --json` wrote, read again: so that a report goes on where it was ended.
#pragma once

#include <optional>
#include <string>

#include "measure/accuracy_tables.h"

namespace shoal::app {

// The points, why it is chaotic, and what was chosen (without candidates). Nothing: there is no such file, or
// none of this version.
std::optional<measure::ReportEntry> readMeasured(const std::string& file);

}  // namespace shoal::app
