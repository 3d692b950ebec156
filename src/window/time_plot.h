// The time of each pass in the last frames: stacked over time, and as a table in the same colours.
#pragma once

#include "gpu/pass_timers.h"

namespace shoal::window {

void drawTimes(const gpu::PassTimers& simulation, const gpu::PassTimers& drawing);

}  // namespace shoal::window
