// Warnings about molecules that are valid but probably not what was meant; for an editor also with the
// elements that they are about and what would mend them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "molecule/draft.h"

namespace shoal {

struct Finding {
    enum class Kind {
        loose,    // a vertex that no spring holds
        unseen,   // a vertex in no triangle
        apart,    // parts that no spring joins
        tension,  // a rest length far from the drawn distance
        flat,     // a triangle without area
        flipped,  // a triangle that faces the other way than its neighbour
        pins,     // that hold all, or do not hold
        masses,   // too far apart
        soft,     // motions that no spring resists
    };
    Kind kind = Kind::soft;
    Warning warning;
    std::vector<int> vertices, springs, triangles;  // that it is about
    std::string remedy;                             // what `mend` does, in a few words; empty: by hand
    std::function<void(Draft&)> mend;

    void mendBy(std::string words, std::function<void(Draft&)> how) {
        remedy = std::move(words);
        mend = std::move(how);
    }
};

// The molecule must be valid (see molecule_file.h).
std::vector<Finding> findingsOf(const Molecule& molecule);

// Located where the molecule was read from a file. Warns of: loose vertices, separate parts, motions that no
// spring resists, flipped and zero-area triangles, vertices that are not drawn, pins that do not hold, masses
// that differ by more than 1e4, and rest lengths far from the drawn distance.
// The molecule must be valid (see molecule_file.h).
std::vector<Warning> check(const Molecule& molecule);

}  // namespace shoal
