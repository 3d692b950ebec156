// Sliders for how the molecules of one group steer by one another.
#pragma once

#include "scene/edit_limits.h"
#include "scene/school.h"

namespace shoal::window {

class SchoolEditor {
  public:
    explicit SchoolEditor(const School& school);

    // Whether the user changed the school in this frame.
    bool draw(School& school) const;

  private:
    // Ranges that grow with what the file says.
    Limit radius_, separation_, rate_, speed_, acceleration_, turn_, wander_, walls_, targets_;
};

}  // namespace shoal::window
