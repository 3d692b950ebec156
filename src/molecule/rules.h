// Defines when a molecule is valid. Its reader holds files to these rules, and compile() molecules made in
// code.
#pragma once

#include "core/where.h"
#include "molecule/molecule.h"

namespace shoal {

// Sizes that single precision on the GPU can square and add without overflow.
constexpr double maxCoordinate = 1e6;  // m
constexpr double mostFrequency = 1e6;  // Hz

// Errors, each at what is wrong.
void checkIndex(int index, const Molecule& molecule, const Location& where);
void checkCorners(const Triangle& triangle, const Location& where);  // three different ones

// All of it, with its skin.
void checkMolecule(const Molecule& molecule, const Where& where);

// The key "defaults" of its file.
const Description& describeDefaults();

}  // namespace shoal
