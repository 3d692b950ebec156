// Keeps a running scene as its files are: the scene, its molecules, models and images, and the shaders.
//
// A file that is broken changes nothing but the problem that is shown, until it is read again and right. What
// happened is said on standard output, what is wrong on standard error.
#pragma once

#include <string>
#include <vector>

#include "core/file_watch.h"
#include "window/running_scene.h"

namespace shoal::window {

class HotReload {
  public:
    // The files of this scene, from now on. `fresh`: another scene than before.
    void follow(const RunningScene& running, bool fresh);

    // Looks and does what is to be done; `now`: s. True: the scene was built anew.
    bool update(RunningScene& running, double now);

    // The window itself wrote a file of the scene's.
    void accept(const std::string& file) { watch_.accept(file); }

    // Why the files as they are do not run; located, empty: they do.
    const std::string& problem() const { return problem_; }

    // Values that were edited in the window and changed in the file, too: they wait for settle().
    const std::vector<std::string>& conflicts() const { return conflicts_; }
    bool settle(RunningScene& running, Prefer prefer);  // true: the scene was built anew

  private:
    bool reload(RunningScene& running, std::optional<Prefer> prefer);
    void tell(const RunningScene::Reloaded& reloaded);
    void tellConflicts(const RunningScene& running) const;
    void fail(const Error& error);

    FileWatch watch_;
    std::vector<std::string> changed_;  // that led to what is reloaded
    std::string problem_;
    std::vector<std::string> conflicts_;
    bool stale_ = false;  // files of the scene changed, and have not been taken
};

}  // namespace shoal::window
