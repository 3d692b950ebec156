// Writes what descriptions say for people.
#pragma once

#include "core/description.h"

namespace shoal {

std::string typeText(const Key& key);   // "number above 0, m", "direction", "true or false"
std::string meaningOf(const Key& key);  // its sentence, and beside what it means something
// What holds where the key is left out, such as "0.5", "required" or "none".
std::string usualText(const Key& key, const Description& keys);

}  // namespace shoal
