// Finds what check() warns of, with the elements that it is about and what would mend it: for an editor.
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

}  // namespace shoal
