// The numbers of the molecule that was picked.
#pragma once

#include <string>

#include "simulate/pick.h"

namespace shoal::app {

enum class MoleculeAction { none, follow, close };

// At the bottom, from `left` on. `follows`: the camera does.
MoleculeAction showMolecule(const PickedMolecule& picked, const std::string& group, const Molecule& shape,
                            const MoleculeNumbers& numbers, bool follows, float left);

// A ring around it on the screen, at `place` in [0, 1] from the upper left corner.
void markMolecule(const glm::dvec2& place, float radius);

}  // namespace shoal::app
