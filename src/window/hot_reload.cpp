#include <algorithm>
#include <iostream>
#include <set>

#include "core/printable.h"
#include "window/running_scene.h"

namespace shoal::window {

void HotReload::follow(const RunningScene& running, bool fresh) {
    watch_.watch(running.files());
    if (!fresh) return;
    problem_.clear();
    conflicts_.clear();
    changed_.clear();
    stale_ = false;
}

bool HotReload::update(RunningScene& running, double time) {
    const std::vector<std::string> changed = watch_.changed(time);
    if (changed.empty()) return false;
    for (const std::string& file : changed) {
        if (std::find(changed_.begin(), changed_.end(), file) == changed_.end()) changed_.push_back(file);
        stale_ |= file.rfind(running.simulation().context().shaders(), 0) != 0;
    }
    return reload(running, {});
}

bool HotReload::settle(RunningScene& running, Prefer prefer) {
    conflicts_.clear();
    return reload(running, prefer);
}

bool HotReload::reload(RunningScene& running, std::optional<Prefer> prefer) {
    bool built = false;
    try {
        if (stale_) {
            const RunningScene::Reloaded reloaded = running.reload(prefer);
            built = reloaded.conflicts.empty() || prefer;
            conflicts_ = prefer ? std::vector<std::string>() : reloaded.conflicts;
            if (built) {
                tell(reloaded);
            } else {
                std::cerr << "shoal: warning: not reloaded yet: " << printable(running.document().file())
                          << " and the window both changed";
                for (const std::string& conflict : conflicts_)
                    std::cerr << (&conflict == conflicts_.data() ? " " : ", ") << printable(conflict);
                std::cerr << std::endl;
            }
        } else {
            running.remakePrograms();
            built = true;
            tell({});
        }
        problem_.clear();
    } catch (const Error& error) {
        if (problem_ != error.what()) {
            problem_ = error.what();
            conflicts_.clear();
            std::cerr << "shoal: warning: not reloaded: " << problem_ << std::endl;
        }
    }
    // a file may name others than before, even where it cannot be taken yet
    follow(running, false);
    if (!built) return false;
    stale_ = false;
    changed_.clear();
    return true;
}

void HotReload::tell(const RunningScene::Reloaded& reloaded) {
    std::cout << "reloaded:";
    for (const std::string& file : changed_)
        std::cout << " " << printable(file);
    if (!reloaded.restarted.empty()) std::cout << "; begins anew:";
    for (const std::string& group : reloaded.restarted)
        std::cout << " " << printable(group);
    std::cout << std::endl;
}

}  // namespace shoal::window
