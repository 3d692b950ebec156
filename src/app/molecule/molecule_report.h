// Reports of a molecule: the sheet of any, the trial and the page of one that was made.
#pragma once

#include <string>

#include "app/line/options.h"
#include "core/image.h"
#include "gpu/context.h"
#include "molecule/molecule.h"

namespace shoal::app {

// A run of two seconds as in a scene, before the molecule is written: what does not run is not kept.
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

// The rest shape and the slowest motions (molecule_show.cpp). Pixels.
Image moleculeSheet(gpu::Context& context, const Molecule& molecule, int width, int height);

// The page, to options.molecule.report; `text`: what the command prints.
void writeMoleculeReport(const Options& options, const Molecule& molecule, const std::string& text);

}  // namespace shoal::app
