// Two changes of one JSON value, made apart, put together.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"

namespace shoal {

enum class Prefer { mine, theirs };

// `base` with what changed in `mine` and what changed in `theirs`. Objects go member by member, arrays of
// objects of one length element by element; anything else is one value. Where both changed a value, and not
// into the same one, its path (from `path`) is put into `conflicts`, and the preferred one is taken.
JsonValue merged(const JsonValue& base, const JsonValue& mine, const JsonValue& theirs, Prefer prefer,
                 const std::string& path, std::vector<std::string>& conflicts);

}  // namespace shoal
