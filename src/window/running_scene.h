// A scene that runs in the window: as its file says, as it was changed since, and what simulates and draws
// it.
//
// Whatever needs another simulation is built beside the one that runs and takes its place, and its state,
// only once it is there: what cannot be had is thrown, and what ran runs on.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/file_watch.h"
#include "core/json_edit.h"
#include "render/renderer.h"
#include "run/request.h"
#include "simulate/simulation.h"

namespace shoal::window {

// The panel's choices in place of the scene's values. They are not saved, and stay when the file changes.
struct GroupChoice {
    std::optional<int> count;
    std::string molecule;  // its file; empty: as in the scene
    // Values of the molecule's material.
    std::optional<double> roughness, translucency, opacity;
    bool any() const { return count || !molecule.empty() || roughness || translucency || opacity; }
};
struct Choices {
    std::map<std::string, GroupChoice> groups;        // by their names
    std::optional<std::optional<SolverKind>> solver;  // inner nothing: auto
};

class RunningScene {
  public:
    // Error: the scene does not fit the context; the driver refuses a program.
    RunningScene(const RunRequest& request, gpu::Context& context, Loaded loaded, int width, int height);

    Scene scene;      // as it is edited; what it does to the run is told by the functions below
    Choices choices;  // the same
    const Scene& original() const { return original_; }  // as in its file
    Simulation& simulation() { return *simulation_; }
    const Simulation& simulation() const { return *simulation_; }
    Renderer& renderer() { return *renderer_; }

    // ---- Each of these: Error, and everything is as it was, but for edit() and choose(), which take back
    // what cannot be had.

    void edit();    // `scene` was edited so that it needs another plan
    void choose();  // `choices` were changed
    void switchPath(Path path);
    void save();    // into the file
    void revert();  // to what the file says

    // json() is the file as it would be saved now; change() makes the scene what another one says. Comments,
    // order and layout of the file stay.
    JsonValue json() const;
    void change(const JsonValue& after);
    // Adds the molecule of a file as a group, and any other file as a model.
    void add(const std::string& file);
    // Take back what change() did, and edits of the scene since, and do it again.
    bool mayUndo() const { return !undo_.empty() || edited(); }
    bool mayRedo() const { return !redo_.empty(); }
    void undo();
    void redo();
    // Makes the programs again on the same path: taking another one when a program is refused would hide the
    // mistake.
    void remakePrograms() { build(scene, simulation_->plan(), simulation_->path().path); }

    bool unsaved() const;  // differs from the file
    // Accepts the groups as they are now: a later edit that fails goes back to them.
    void accept() { accepted_ = scene.groups; }

    // Takes over a change of the file, or of one that it names. Unsaved edits and choices are kept where the
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
    std::string text() const;  // with what was edited in `scene`
    bool edited() const;       // `scene` is not as text_ says
    Scene read(const std::string& text) const;
    // These return the groups that begin anew.
    std::vector<std::string> replace(Scene fresh, bool keepsChoices);
    std::vector<std::string> take(const std::string& text);
    void go(const std::string& text, std::vector<std::string>& passed);
    std::unique_ptr<Simulation> simulate(Plan plan, Path path);
    std::unique_ptr<Simulation> simulateAsBefore(const Plan& plan, Path path);
    std::vector<std::string> build(Scene next, const Plan& plan, Path path);
    std::vector<std::string> build(Scene next, bool warns = false);  // compiled; `warns`: of the plan
    Plan compileStably(Scene& next) const;
    void applyChoices(Scene& next, const Scene& from) const;
    std::vector<std::string> changedChoices(const Scene& theirs) const;

    const RunRequest& request_;
    gpu::Context* context_;
    Scene original_;
    std::string text_, saved_;              // that original_ was read from; of the file
    std::vector<std::string> undo_, redo_;  // texts
    std::vector<Group> accepted_;
    Choices acceptedChoices_;
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
