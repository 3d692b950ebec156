// Which 3x3 blocks the factors of a molecule's matrix have, one row and column a vertex: those of the
// springs, and what elimination adds. A molecule is a chain of few neighbours, and its factors keep that,
// while the inverse is full (24 vertices of the fish: 140 blocks against 300). Whatever the numbers are, a
// molecule type has one pattern.
#pragma once

#include <vector>

#include "molecule/molecule.h"

namespace shoal {

// Orders of elimination. Both take the vertex with the fewest neighbours.
enum class Elimination {
    fewestBlocks,  // one after the other
    fewestRounds,  // as many at a time as are no neighbours, of few enough neighbours: more blocks
};

struct BlockPattern {
    std::vector<int> order;  // vertices, as they are eliminated; without pinned ones
    std::vector<std::vector<int>>
        below;  // for each place in `order`: later places that it is joined to, rising
    std::vector<std::vector<int>> block;  // likewise: the number of that block
    std::vector<int> diagonal;            // for each place: the number of its block on the diagonal
    std::vector<int> rounds;              // the first place of each round, within which no two are joined
    int blocks = 0;
};

// `held`: pinned vertices take no part.
BlockPattern blockPattern(const Molecule& molecule, bool held,
                          Elimination elimination = Elimination::fewestBlocks);

}  // namespace shoal
