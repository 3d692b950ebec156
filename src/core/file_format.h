// The version that a file says it is of.
#pragma once

#include <string>

#include "core/json.h"

namespace shoal {

// The key "format", such as "shoal-scene-1". Error: missing or another, with the one that is read; that of a
// newer version is told as such.
void needFormat(JsonReader& root, const std::string& expected);

}  // namespace shoal
