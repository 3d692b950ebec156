// The two panels of the viewer: how the scene runs, and what it says of its groups.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "simulate/simulation.h"
#include "window/explanations.h"
#include "window/gizmo.h"
#include "window/json_rows.h"
#include "window/key_rows.h"
#include "window/running_scene.h"

namespace shoal::window {

std::vector<std::string> shippedMolecules();  // files

// ---- How the scene runs

// The values of the sliders. The simulation's parameters follow them over a fifth of a second, so that a
// sudden move does not kick the springs.
struct Controls {
    glm::dvec3 gravity{0};
    float gravityFactor = 1, wind = 1, drag = 1, stiffness = 1, damping = 1;
    std::vector<float> forces;              // factors on the strengths of the scene's
    std::vector<float> fields;              // factors on the weights of the scene's
    int substeps = 4, plannedSubsteps = 4;  // the plan's own
    bool paused = false;

    explicit Controls(const Plan& plan);
    void follow(const Parameters& parameters);  // as a run that was resumed has them
    void follow(const Plan& plan);              // of a scene that was built anew: what the user moved stays
    void lead(Parameters& parameters, const Plan& plan, double seconds) const;
};

// Decker's interface (forces, number and kind of molecules), the clock, how it is solved, and what a frame
// costs.
class Panel {
  public:
    enum class Action { none, step, restart, rebuild, switchPath, resetCamera, scenes, measure };

    explicit Panel(const Scene& scene);
    void follow(const Scene& scene);  // that was built anew

    // Draws the panel and returns what the user asked for in this frame.
    Action draw(Controls& controls, Simulation& simulation, Renderer& renderer, Explanations& explanations,
                double frameSeconds, const gpu::Traffic& lastFrame);

    // Puts the choices for which draw() asks for a rebuild into `choices`.
    void apply(Choices& choices) const;
    std::string error;            // of the method, as measured; empty: it was not
    Path path = Path::automatic;  // that runs, and after switchPath the one to go on with

  private:
    Action drawClock(Controls& controls, const Simulation& simulation);
    void drawForces(Controls& controls, const Simulation& simulation);
    Action drawGroups();
    Action drawMethod(Controls& controls, const Simulation& simulation);
    void drawView(Explanations& explanations, const Simulation& simulation);
    void drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                  const gpu::Traffic& lastFrame);

    struct Listed {
        std::string name;
        int count = 0;           // as in the scene
        bool fixed = false;      // placed one by one, or none at the start: the number cannot be changed
        bool particles = false;  // which are of no other kind
        std::string molecule;    // chosen file; empty: as in the scene
        int chosen = 0;          // count
    };
    std::vector<Listed> groups_;
    std::vector<std::string> molecules_;  // files to choose from
    int group_ = 0;                       // of groups_, that is shown
    std::optional<int> solver_;           // chosen: of solverWords()
    std::vector<std::string> forceNames_, fieldNames_;
    std::string sceneName_;
};

// Draws the time of each pass in the last frames: stacked over time, and as a table in the same colours.
void drawTimes(const gpu::PassTimers& simulation, const gpu::PassTimers& drawing);

// Measures the error of a few molecules of each group of `scene`, from its start over half a second, by the
// solver and substeps of the simulation against the double-precision reference: "error 1.2e-4 of its size
// (RMS of 4 after 0.5 s)", or why there is none. Takes seconds.
std::string methodError(const Scene& scene, const Simulation& simulation);

// ---- What the scene says of its groups

// Sliders for birth and death of a group of the scene; whether the user changed it in this frame.
bool drawEmitters(Scene& scene, size_t group, KeyRows& rows);
bool drawLife(Scene& scene, size_t group, KeyRows& rows);
// Sliders for the looks of point particles, likewise. `ages`: the group has a life cycle.
bool drawParticles(ParticleType& type, bool ages, KeyRows& rows);

// Each group's looks, birth and death, edited while it runs, and saved into the scene file.
//
// Edits take effect at once where they can; for those that need another plan the panel asks for a rebuild
// when the user releases the widget.
class ScenePanel {
  public:
    enum class Action { none, save, revert, rebuild, change, undo, redo };

    explicit ScenePanel(const Scene& scene) { follow(scene); }

    bool changed() const { return changed_; }      // in the last draw
    void showWhole() { whole_ = true; }            // the scene, instead of its groups
    bool holds() const { return gizmo_.holds(); }  // something in the picture, for the pointer
    bool pending() const { return pending_; }      // something was edited that does not run yet
    // Edits running.scene and its choices. `unsaved`: it is not as its file. `view`: what is seen.
    Action draw(RunningScene& running, bool unsaved, const View& view);
    // The scene's groups are others than those that were edited: after a rebuild or one that failed.
    void follow(const Scene& scene);
    // The scene that Action::change asks for; null: none. accept() removes it from the panel. After refuse()
    // it stays there, to be completed or dropped.
    const JsonValue* draft() const { return draft_ && draft_->changed ? &draft_->json : nullptr; }
    bool drafted() const { return draft_ && (draft_->changed || draft_->refused); }
    bool refused() const { return draft_ && draft_->refused; }
    void accept() { draft_.reset(); }
    void refuse() { draft_->changed = false, draft_->refused = true; }
    void say(const std::string& word) { said_ = word; }  // beside the buttons, until something changes

  private:
    struct Edited {
        size_t group = 0;  // of the scene
        KeyRows rows;
        LifeCounts counts = {};
        double countedAt = -1;  // s, of the wall clock
    };
    Action drawHead(const Scene& scene, bool unsaved);
    Action drawWhole(RunningScene& running, const View& view);
    bool moveHandles(const std::vector<JsonRows::Place>& places, const View& view, bool may);
    void drawGroup(Edited& edited, RunningScene& running);
    void drawCounts(Edited& edited, Simulation& simulation, size_t planGroup);

    std::vector<Edited> groups_;
    std::string said_;
    bool changed_ = false;
    bool lives_ = false;    // some group has particles, a life cycle or a school
    bool pending_ = false;  // a rebuild, when the user releases the widget
    bool whole_ = false;    // all that the file says is shown, instead of the groups
    Gizmo gizmo_;           // of what is open
    struct Draft {
        JsonValue base, json;  // what the scene said, and is to say
        bool changed = false, refused = false;
        bool stale = false;  // the scene has changed otherwise since
    };
    std::optional<Draft> draft_;
    std::vector<std::string> molecules_;  // that a group may have, as the file names them
};

}  // namespace shoal::window
