// A molecule in the words of its file.
#pragma once

#include "core/json.h"
#include "molecule/molecule.h"

namespace shoal {

// `spelled`: every vertex and spring says its own mass, stiffness and damping, and there are no defaults.
JsonValue toJson(const Molecule& molecule, bool spelled);

}  // namespace shoal
