// "school" of a group as a scene file has it. What readSchool reads of it is the same.
#pragma once

#include "core/json.h"
#include "scene/school.h"

namespace shoal {

// Keys that stand for what is so without them are left out.
JsonValue writeSchool(const School& school);

}  // namespace shoal
