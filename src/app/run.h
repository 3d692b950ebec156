// `shoal run`: headless, or in a window (window.h).
#pragma once

#include "app/commands.h"
#include "gpu/context.h"

namespace shoal::app {

// Frames, pictures and exports without a window.
int runHeadless(const Options& options, gpu::Context& context, Loaded loaded);
// Until the user closes it, or after --frames.
int runWindow(const Options& options, gpu::Context& context, Loaded loaded);

}  // namespace shoal::app
