// A run that goes on with another plan of the same groups: more or fewer places, other emitters or other
// numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulate/simulation.h"

namespace shoal {

// The state of a run of `from` as `to` can load it. What is in places that are no more is gone, places that
// are new are free. Nothing where the groups are not the same molecules, or as many that live for ever.
std::optional<SavedState> carryOver(const SavedState& saved, const Plan& from, const Plan& to);

// Carries over group by group, for files that changed: each group of `to` goes on where `from` has it (by
// name, else by number) with as many vertices a molecule, and both or neither with life. As many molecules as
// both have go on; further places are free in a group with life, else as at the start, as other groups are.
struct GoneOn {
    SavedState state;
    std::vector<std::string> restarted;  // names of the groups that begin anew
};
GoneOn goOn(const SavedState& saved, const Plan& from, const Plan& to);

}  // namespace shoal
