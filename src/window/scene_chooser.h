// A list of scenes as buttons, in the middle of the window.
#pragma once

#include <string>
#include <vector>

#include "core/file_watch.h"
#include "run/scene_list.h"

namespace shoal::window {

class SceneChooser {
  public:
    bool open = false;

    void list(const std::string& folder);  // what lies in it or below; opens
    // A scene that was chosen cannot be opened, until one of its files changes.
    void refused(const std::string& file);
    bool changed(double now) { return !refused_.changed(now).empty(); }  // such a file has; s

    // Which scene was chosen; empty: none. `mustChoose`: nothing runs yet, so that it cannot be closed.
    // `message`: above the list.
    std::string draw(bool mustChoose, const std::string& message);

  private:
    std::vector<ListedScene> scenes_;
    std::string folder_;
    FileWatch refused_;
};

}  // namespace shoal::window
