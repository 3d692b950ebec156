// Chooses the pairs of vertices of a coarse mesh that get springs, and says why.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "author/coarse.h"
#include "molecule/molecule.h"

namespace shoal {

using Pair = std::pair<int, int>;  // the smaller first

struct SpringPairs {
    std::vector<Pair> edges;   // of the surface, or of tetrahedra
    std::vector<Pair> shears;  // the other diagonal of two triangles that lie nearly in one plane
    std::vector<Pair> bends;   // the same of two triangles that are folded
    std::vector<Pair> braces;  // from a vertex through the inside to the far wall
    std::set<Pair> all;

    // Nothing happens when the two are sprung already.
    void add(std::vector<Pair>& kind, int a, int b);
};

// Springs for ringsOf(): around and along, both diagonals between neighbouring rings, and both across each
// ring. A bend sideways shortens one flank and lengthens the other.
SpringPairs springsOfRings(int rings);

// `inside`: null for a sheet, which gets no braces.
SpringPairs springsOf(const CoarseMesh& coarse, const Inside* inside);

// Adds springs until nothing but rigid motion is without stiffness; of all pairs each time the one that
// resists the softest motion most for its length. `molecule` has vertices with masses and all springs so far.
// `hardly`: what is held, but hardly, gets more.
struct Bracing {
    std::vector<Pair> added;
    int left = 0;  // motions that no pair resists: of what is flat
};
Bracing brace(Molecule molecule, const Inside* inside, bool hardly);

}  // namespace shoal
