// What the molecule costs: many of it, stepped here and now.
#pragma once

#include <string>

#include "app/editor_stage.h"

namespace shoal::app {

struct MoleculeCost {
    double secondsPerMolecule = 0;  // of a frame, simulate only
    int measuredAt = 0;             // molecules
    std::string machine;            // in words
};

// Steps `count` of the molecule in a field of gusts for about a tenth of a second. Error: compile's.
MoleculeCost measureCost(gpu::Context& context, gpu::ProgramCache& cache, const Molecule& molecule,
                         const StageSettings& settings, int count = 4096);

}  // namespace shoal::app
