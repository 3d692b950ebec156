// Runs a new molecule for two seconds before it is written, as a scene would: what does not run is not kept.
#pragma once

#include <string>

#include "app/line/options.h"
#include "molecule/molecule.h"

namespace shoal::app {

struct Trial {
    static constexpr int frames = 120;  // of 1/60 s
    std::string solver;                 // as "auto" chose it
    int substeps = 0;                   // a frame
    double change = 0;                  // of a spring's length by that length, the most
    double speed = 0;                   // m/s at the end, the fastest vertex
    std::string untried;                // why it could not run here; empty: it ran
};

// Lets one molecule fall by half its size onto a floor; its pins hold. It takes the default substeps of a
// scene, or more where it needs more. Error: it does not run, and why.
Trial tryOut(const Molecule& molecule, const Options& options);

}  // namespace shoal::app
