// Analyses a molecule's springs and bends: its frequencies, the motions that nothing resists, the stable
// steps, and its motions one by one.
//
// Linearised about the drawn shape: M x'' + C x' + K x = 0 with K = sum of k n n^T and C = sum of c n n^T
// over the springs, bends among them (WeightedSpring). Prestress (a restLength other than the drawn distance)
// is left out of K; check() warns of it. Pinned vertices do not move.
#pragma once

#include <numbers>

#include "molecule/molecule.h"

namespace shoal {

// Hz, of a frequency in rad/s.
inline double hertz(double rate) {
    return rate / (2 * std::numbers::pi);
}

struct Analysis {
    double highestFrequency = 0;  // rad/s, undamped, in the drawn shape
    double frequencyBound = 0;    // rad/s, which no deformed shape exceeds (see analysis.cpp)
    double lowestFrequency = 0;   // rad/s, the lowest above 0; 0 when there is none or modes are not known
    int rigidModes = 0;           // rigid motions that the pins leave: 6 free, 3 for a point, 1 on a hinge, 0
    int zeroModes = 0;            // further motions that no spring or bend resists to first order
    bool modesKnown = true;       // false above 300 vertices, where only the highest frequency is found

    // s; infinite without springs. Sufficient for every mode, with the actual damping (analysis.cpp).
    double stableStepEuler = 0;     // largest eigenvalue of h^2 K + 2 h C below 4
    double stableStepLeapfrog = 0;  // largest eigenvalue of h^2 K + 4 h C below 4: the force sees v + a h/2
    // 1/s; bounds the roots of z^2 + b z + a = 0, a and b the largest of squared frequency and damping.
    double fastestRate = 0;

    double totalMass = 0;   // kg, pinned vertices too
    double restEnergy = 0;  // J, in the springs of the drawn shape
    int vertices = 0, springs = 0, bends = 0, triangles = 0;
};

// `pinned`: pins hold; otherwise as after their release. The molecule must be valid (see molecule_file.h).
Analysis analyse(const Molecule& molecule, bool pinned);

// A motion that the springs allow.
struct Mode {
    double frequency = 0;           // rad/s; 0: no spring resists it to first order
    std::vector<glm::dvec3> shape;  // of every vertex: how it moves; the largest has length 1
};

// The slowest ones first, at most `most`, without the rigid motions; linearised as above.
// Empty above 300 vertices. `pinned`: pins hold. The molecule must be valid (see molecule_file.h).
std::vector<Mode> modesOf(const Molecule& molecule, bool pinned, size_t most);

// Returns the reach of a spring of a body along z that bends about +Y, m: its length at rest changes by the
// share of this times the curvature (1/m, to the left where positive).
double bendReach(const Molecule& molecule, const Spring& spring);

}  // namespace shoal
