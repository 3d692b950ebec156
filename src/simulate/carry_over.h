// A run that goes on with another plan of the same groups: more or fewer places, other emitters or other
// numbers.
#pragma once

#include <optional>

#include "simulate/simulation.h"

namespace shoal {

// The state of a run of `from` as `to` can load it. What is in places that are no more is gone, places that
// are new are free. Nothing where the groups are not the same molecules, or as many that live for ever.
std::optional<SavedState> carryOver(const SavedState& saved, const Plan& from, const Plan& to);

}  // namespace shoal
