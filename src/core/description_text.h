// Writes what descriptions say for people.
#pragma once

#include "core/description.h"

namespace shoal {

// "vector, m", "0 to 1", "\"none\", \"yaw\" or \"any\""; and what holds where the key is left out, such as
// "0.5", "required" or "none".
std::string typeText(const Key& key);
std::string meaningOf(const Key& key);  // its sentence, and beside what it means something
std::string usualText(const Key& key, const Description& keys);

}  // namespace shoal
