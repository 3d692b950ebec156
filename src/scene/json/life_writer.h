// From a Lifecycle to "life" and "emitters" of a group in a scene file.
#pragma once

#include <optional>
#include <vector>

#include "core/json.h"
#include "scene/scene.h"

namespace shoal {

// Of a group with life: only what differs from the defaults and has an effect; reads back as the same, but
// that what had no effect is at its default then. "capacity" is written where it is not usualCapacity.
// Nothing where the key is not needed.
std::optional<JsonValue> writeLife(const Group& group);
std::optional<JsonValue> writeEmitters(const Group& group, const std::vector<Model>& models);

}  // namespace shoal
