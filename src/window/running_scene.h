// A scene that runs in the window: its document, and what simulates and draws it.
//
// Whatever needs another simulation is built beside the one that runs and takes its place, and its state,
// only once it is there: what cannot be had is thrown, and what ran runs on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/file_watch.h"
#include "run/request.h"
#include "window/apply_live.h"
#include "window/scene_document.h"

namespace shoal::window {

class RunningScene {
  public:
    // Error: the scene does not fit the context; the driver refuses a program.
    RunningScene(const RunRequest& request, gpu::Context& context, Loaded loaded, int width, int height);

    const Scene& scene() const { return scene_; }  // as it runs
    const SceneDocument& document() const { return document_; }
    Simulation& simulation() { return *simulation_; }
    const Simulation& simulation() const { return *simulation_; }
    Renderer& renderer() { return *renderer_; }
    int builds() const { return builds_; }  // how often another simulation or renderer was made

    // ---- Each of these: Error, and everything is as it was.

    // Makes the document say `after`. What cannot be taken by the run as it goes on has another simulation,
    // which goes on from its state.
    void change(const JsonValue& after, bool trial = false);
    // The same, only if the run can take it as it goes on; false: it cannot, and nothing has changed. All of
    // these up to release(), and a change() before it, are one step of undo.
    bool changeLive(const JsonValue& after);
    void release() { held_ = false; }
    // Draws the colliders as `after` has them, where only their numbers differ, while the run goes on.
    void showColliders(const JsonValue& after);
    // Adds the molecule of a file as a group, and any other file as a model.
    void add(const std::string& file);
    void keepTrials() { document_.take(document_.withTrials()); }
    void dropTrials() { go(document_.withoutTrials()); }
    void undo();
    void redo();
    void revert() { go(document_.saved()); }  // to what the file says
    void save();                              // into the file, without the trials

    void switchPath(Path path);
    // Makes the programs again on the same path: taking another one when a program is refused would hide the
    // mistake.
    void remakePrograms() { build(scene_, simulation_->plan(), simulation_->path().path); }

    // Takes over a change of the file, or of one that it names. Unsaved edits and trials are kept where the
    // file did not change the same value. Where it did, the conflicts are returned and nothing else happens,
    // unless `prefer` says who wins.
    struct Reloaded {
        std::vector<std::string> conflicts;  // what both changed, each its own way
        std::vector<std::string> restarted;  // groups that begin anew: they have another shape
    };
    Reloaded reload(std::optional<Prefer> prefer = {});

    // All files that were read for it, those of its programs among them.
    std::vector<std::string> files() const;

  private:
    Scene read(const std::string& text) const;
    void keepCapacities(const SceneDifference& difference, const std::vector<Group>& before,
                        SceneDocument::Texts& next, bool trial);
    bool takeLive(const SceneDifference& difference, SceneDocument::Texts& next, std::optional<bool> trial);
    void follow(SceneDocument::Texts& next, std::optional<bool> trial);
    void go(SceneDocument::Texts next);
    Plan compileStably(Scene& next) const;
    std::unique_ptr<Simulation> simulate(Plan plan, Path path);
    std::unique_ptr<Simulation> simulateAsBefore(const Plan& plan, Path path);
    std::unique_ptr<Renderer> draws(const Scene& scene, Simulation& simulation) const;
    // These return the groups that begin anew.
    std::vector<std::string> build(Scene next, const Plan& plan, Path path);
    std::vector<std::string> build(Scene next);

    const RunRequest& request_;
    gpu::Context* context_;
    SceneDocument document_;
    Scene scene_;
    bool held_ = false;  // a live edit goes on
    JsonValue shown_;    // the list of colliders that is drawn, where it is not the document's
    int builds_ = 0;
    Path path_;
    int width_, height_;  // pixels, at the start
    std::unique_ptr<Simulation> simulation_;
    std::unique_ptr<Renderer> renderer_;
};

// Keeps a running scene as its files are: the scene, its molecules, models and images, and the shaders.
//
// A file that is broken changes nothing but the problem that is shown, until it is read again and right. What
// happened is said on standard output, what is wrong on standard error.
class HotReload {
  public:
    // The files of this scene, from now on. `fresh`: another scene than before.
    void follow(const RunningScene& running, bool fresh);

    // Looks and does what is to be done; `time`: s. True: the scene was built anew.
    bool update(RunningScene& running, double time);

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

    FileWatch watch_;
    std::vector<std::string> changed_;  // that led to what is reloaded
    std::string problem_;
    std::vector<std::string> conflicts_;
    bool stale_ = false;  // files of the scene changed, and have not been taken
};

}  // namespace shoal::window
