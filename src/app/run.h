// `shoal run`: headless, or in a window (`runWindow`).
#pragma once

#include <optional>

#include "app/commands.h"
#include "gpu/context.h"
#include "gpu/program_cache.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Frames, pictures and exports without a window.
int runHeadless(const Options& options, gpu::Context& context, Loaded loaded);
// Until the user closes it, or after --frames.
// Without a scene it lists those to choose from.
int runWindow(const Options& options, gpu::Context& context, std::optional<Loaded> loaded);

// What the making of a simulation had to say, on standard error.
void tellWarnings(const Simulation& simulation, gpu::ProgramCache& cache);

}  // namespace shoal::app
