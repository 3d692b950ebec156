// Shows the baking of distance fields when it takes long.
#pragma once

#include <chrono>
#include <optional>

#include "app/progress.h"
#include "geometry/distance_field_cache.h"

namespace shoal::app {

class FieldWatch {
  public:
    // For readScene, while this lives: from the cache's own folder.
    FieldBaking baking();

  private:
    void show(double share);

    std::optional<Progress> bar_;
    int shown_ = 0;  // hundredths
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace shoal::app
