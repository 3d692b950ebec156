// A run that goes on with another plan, because files or values have changed.
#pragma once

#include <string>
#include <vector>

#include "simulate/simulation.h"

namespace shoal {

// Returns the state of a run of `from` in a form that `to` can load. A group of `to` continues the same group
// of `from` (by its name, else by its number) if both have as many vertices a molecule and both or neither
// have life; other groups begin anew. As many molecules continue as both groups have. Further places are free
// in a group with life, and else as at the start.
struct GoneOn {
    SavedState state;
    std::vector<std::string> restarted;  // names of the groups that begin anew
};
GoneOn goOn(const SavedState& saved, const Plan& from, const Plan& to);

}  // namespace shoal
