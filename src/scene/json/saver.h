// Saves what was edited in a running scene: "particle", "color", "secondColor", "school", "life" and
// "emitters" of its groups. The rest of the file, its layout and every number that was not edited stay as
// they are, whoever wrote them and when.
#pragma once

#include <string>
#include <vector>

#include "core/json_edit.h"
#include "scene/scene.h"

namespace shoal {

// `text` of a scene file that was read as `before`, perhaps with other things changed since, with what
// differs in `after`. Both have the same groups. Error: it has not, or it would not read back.
std::string withEdits(const std::string& text, const Scene& before, const Scene& after);

// Copies the values of these keys.
void copyEdited(const Group& from, Group& to);

// Whether saving would change a file.
bool differ(const Scene& before, const Scene& after);

}  // namespace shoal
