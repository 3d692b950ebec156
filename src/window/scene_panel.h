// The second panel: each group's looks, birth and death, edited while it runs, and saved into the scene file.
//
// Edits take effect at once where they can; for those that need another plan the panel asks for a rebuild
// when the user releases the widget.
#pragma once

#include <string>
#include <vector>

#include "window/group_editors.h"
#include "window/running_scene.h"

namespace shoal::window {

class ScenePanel {
  public:
    enum class Action { none, save, revert, rebuild };

    explicit ScenePanel(const Scene& scene);

    bool empty() const { return groups_.empty(); }
    bool changed() const { return changed_; }  // in the last draw
    bool pending() const { return pending_; }  // something was edited that does not run yet
    // Edits running.scene and its choices. `unsaved`: it is not as its file.
    Action draw(RunningScene& running, bool unsaved);
    // The scene's groups are others than those that were edited: after a rebuild or one that failed.
    void follow(const Scene& scene);
    void say(const std::string& word) { said_ = word; }  // beside the buttons, until something changes

  private:
    struct Edited {
        size_t group;  // of the scene
        std::optional<LifeEditor> life;
        std::optional<ParticleEditor> looks;
        std::optional<KeyRows> school;
        LifeCounts counts = {};
        double countedAt = -1;  // s, of the wall clock
    };
    Action drawHead(const Scene& scene, bool unsaved);
    static std::optional<Edited> edited(const Scene& scene, size_t group);
    void drawGroup(Edited& edited, RunningScene& running);
    void drawCounts(Edited& edited, Simulation& simulation, size_t planGroup);

    std::vector<Edited> groups_;
    std::string said_;
    bool changed_ = false;
    bool lives_ = false;    // some group has particles, a life cycle or a school
    bool pending_ = false;  // a rebuild, when the user releases the widget
};

}  // namespace shoal::window
