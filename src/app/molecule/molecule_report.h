// The sheet of a molecule, and the page of one that was made.
#pragma once

#include <string>

#include "app/line/options.h"
#include "core/image.h"
#include "gpu/context.h"
#include "molecule/molecule.h"

namespace shoal::app {

// The rest shape and the slowest motions (molecule_show.cpp). Pixels.
Image moleculeSheet(gpu::Context& context, const Molecule& molecule, int width, int height);

// The page, to options.molecule.report; `text`: what the command prints.
void writeMoleculeReport(const Options& options, const Molecule& molecule, const std::string& text);

}  // namespace shoal::app
