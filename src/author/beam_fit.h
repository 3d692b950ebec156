// Fits the stiffness of a molecule to the beam that its mesh is: as a whole to the lowest frequency of the
// free beam, and what joins pinned vertices to others to the beam that is clamped there.
#pragma once

#include <optional>
#include <vector>

#include "author/beam.h"
#include "molecule/molecule.h"

namespace shoal {

// A figure of a molecule and of its beam.
struct Likeness {
    double molecule = 0, beam = 0;
    double error() const { return molecule / beam - 1; }
};

// Clamped up to a place of the beam's axis, or with `turned` from there on: places seen from the other end,
// which change their sign.
struct Clamp {
    double place = 0;  // m, along the axis
    bool turned = false;
};

struct ClampedFigures {
    Likeness sag;                         // m, of the end under its own weight
    std::vector<Likeness> frequencies{};  // Hz, of bending, rising
};

// Of a molecule whose masses are the beam's. `count`: of frequencies. Error: statics.h's.
std::vector<Likeness> freeFigures(const Molecule& molecule, const Beam& beam, const MassSpread& spread,
                                  size_t count);
// With its pins. A `count` of 0 gives the lowest by Rayleigh's quotient of the sag, which is quicker. Error:
// statics.h's.
ClampedFigures clampedFigures(const Molecule& molecule, const Beam& beam, const MassSpread& spread,
                              const Clamp& clamp, size_t count);

// Where the pinned vertices of a mesh end, when they are those of one end of its axis, and more than a point
// or a line across it.
std::optional<Clamp> clampOf(const Mesh& mesh, const std::vector<bool>& pinned, const MassSpread& spread);

// The stiffness of springs as the beam's changes along it, by the square of the distance of the vertices
// there from its middle.
void shapeStiffness(Molecule& molecule, const Beam& beam, const MassSpread& spread);
// All stiffness by one factor, so that the lowest frequency of bending is the free beam's.
void fitFree(Molecule& molecule, const Beam& beam, const MassSpread& spread);
// The stiffness of what joins pinned vertices to others by another, so that sag and lowest frequency of the
// clamped molecule are off by the same share.
void fitClamped(Molecule& molecule, const Beam& beam, const MassSpread& spread, const Clamp& clamp);

}  // namespace shoal
