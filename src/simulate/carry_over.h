// A run that goes on with another plan, because files or values have changed.
#pragma once

#include <string>
#include <vector>

#include "simulate/simulation.h"

namespace shoal {

// The state of a run of `from` as `to` can load it. Each group of `to` goes on where `from` has it (by name,
// else by number) with as many vertices a molecule, and both or neither with life. As many molecules as both
// have go on; further places are free in a group with life, else as at the start, as other groups are.
struct GoneOn {
    SavedState state;
    std::vector<std::string> restarted;  // names of the groups that begin anew
};
GoneOn goOn(const SavedState& saved, const Plan& from, const Plan& to);

}  // namespace shoal
