// The two panels of the viewer: how the scene runs, and what it says of its groups.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "measure/diagnostics.h"
#include "render/renderer.h"
#include "simulate/simulation.h"
#include "window/explanations.h"
#include "window/frame_rate.h"
#include "window/gizmo.h"
#include "window/json_rows.h"
#include "window/running_scene.h"

namespace shoal::window {

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
    bool moved(const Plan& plan) const;  // some slider, from where the scene has it
};

// Decker's interface (forces, number and kind of molecules), the clock, how it is solved, and what a frame
// costs. Numbers, kinds and the solver are tried out: edits of the scene's document for this run alone.
class Panel {
  public:
    enum class Action {
        none,
        step,
        restart,
        tryOut,
        keep,
        drop,
        write,
        switchPath,
        resetCamera,
        scenes,
        measure
    };

    explicit Panel(const Scene& scene);
    void follow(const Scene& scene);  // that was built anew

    // Draws the panel and returns what the user asked for in this frame. Null: there are no diagnostics.
    Action draw(Controls& controls, RunningScene& running, Explanations& explanations, FrameRate& rate,
                double frameSeconds, const gpu::Traffic& lastFrame, const measure::Diagnostics* diagnostics);
    const JsonValue& tried() const { return tried_; }  // what the scene is to say after tryOut

    std::string error;            // of the method, as measured; empty: it was not
    Path path = Path::automatic;  // that runs, and after switchPath the one to go on with

  private:
    Action drawClock(Controls& controls, const Simulation& simulation);
    Action drawForces(Controls& controls, const Simulation& simulation);
    Action drawTrials(const SceneDocument& document);
    Action drawGroups(const RunningScene& running);
    Action drawMethod(Controls& controls, const RunningScene& running);
    void drawView(Explanations& explanations, const Simulation& simulation, FrameRate& rate);
    void drawCost(Simulation& simulation, Renderer& renderer, double frameSeconds,
                  const gpu::Traffic& lastFrame, const measure::Diagnostics* diagnostics);

    JsonValue tried_;
    int group_ = 0;                       // of the scene, that is shown
    std::optional<int> number_;           // while its slider is held
    std::vector<std::string> molecules_;  // to choose from, as the scene names them
    std::vector<std::string> forceNames_, fieldNames_;
    std::string sceneName_;
};

// The scene with what the sliders multiply: gravity, fields and forces, drag, springs, and the substeps.
JsonValue withControls(JsonValue root, const Scene& scene, const Controls& controls);

// Draws the time of each pass in the last frames: stacked over time, and as a table in the same colours.
void drawTimes(const gpu::PassTimers& simulation, const gpu::PassTimers& drawing);

// Draws a bar as long as the error's logarithm, with what else a run tells of itself in its tooltip.
void drawDiagnostics(const measure::Diagnostics& diagnostics);

// Measures the error of a few molecules of each group of `scene`, from its start over half a second, by the
// solver and substeps of the simulation against the double-precision reference: "error 1.2e-4 of its size
// (RMS of 4 after 0.5 s)", or why there is none. Takes seconds.
std::string methodError(const Scene& scene, const Simulation& simulation);

// ---- What the scene says of its groups

// All that the scene says, or its groups alone, edited while it runs.
//
// What is edited takes effect at once where the run can take it as it goes on, else when the user releases
// the widget.
class ScenePanel {
  public:
    enum class Action { none, save, revert, change, undo, redo };

    explicit ScenePanel(const Scene& scene);

    void showWhole() { whole_ = true; }            // the scene, instead of its groups
    bool holds() const { return gizmo_.holds(); }  // something in the picture, for the pointer
    // `unsaved`: it is not as its file. `view`: what is seen.
    Action draw(RunningScene& running, bool unsaved, const View& view);
    void follow() { stale_ = true; }  // the document says something else
    // The scene that Action::change asks for; null: none. accept() removes it from the panel. After refuse()
    // it stays there, to be completed or dropped.
    const JsonValue* draft() const { return draft_ && draft_->changed ? &draft_->json : nullptr; }
    bool drafted() const { return draft_ && (draft_->changed || draft_->refused); }
    bool refused() const { return draft_ && draft_->refused; }
    void accept() { draft_.reset(); }
    void refuse() { draft_->changed = false, draft_->refused = true; }
    void say(const std::string& word) { said_ = word; }  // beside the buttons, until something changes

  private:
    Action drawHead(const SceneDocument& document, bool unsaved);
    Action drawSteps(const RunningScene& running, const View& view);
    bool drawGroups(RunningScene& running);
    void drawCounts(Simulation& simulation, size_t planGroup);
    void renew(RunningScene& running);
    void goLive(RunningScene& running);
    bool moveHandles(const std::vector<JsonRows::Place>& places, const View& view, bool may);

    JsonRows rows_;
    std::map<std::string, std::vector<std::string>> words_;  // that a key may say
    struct Counted {
        LifeCounts counts = {};
        double time = -1;  // s, of the wall clock
    };
    std::map<size_t, Counted> counted_;  // by the group in the plan
    std::string said_;
    bool lives_ = false;  // some group has particles, a life cycle or a school
    bool whole_ = false;  // all that the file says is shown, instead of the groups
    bool stale_ = false;  // the document has changed since the draft was taken
    Gizmo gizmo_;         // of what is open
    float height_ = 0;    // of the rows
    std::string broken_;  // why what is held cannot run as it is
    struct Draft {
        JsonValue base, json;  // what the scene said, and is to say
        bool changed = false, refused = false;
    };
    std::optional<Draft> draft_;
};

}  // namespace shoal::window
