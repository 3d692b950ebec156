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

// Holds the outcome of merging unsaved edits into a file that changed since it was read.
struct MergedEdits {
    std::vector<Group> groups;           // of `theirs`, with the edits
    std::vector<std::string> conflicts;  // paths of what both changed, each its own way, or what is gone
    bool possible = true;                // false: a group that was edited is not there any more
};
// `text`: of the file as it is now, which was read as `theirs`. Error: the two together do not read back.
MergedEdits mergeEdits(const Scene& before, const Scene& after, const Scene& theirs, const std::string& text,
                       Prefer prefer);

}  // namespace shoal
