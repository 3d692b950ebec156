// A scene that is open in the window, and all that the user moves of it.
#pragma once

#include <imgui.h>

#include "measure/diagnostics.h"
#include "window/explanations.h"
#include "window/frame_rate.h"
#include "window/orbit_camera.h"
#include "window/panel.h"
#include "window/running_scene.h"
#include "window/time_line.h"

namespace shoal::window {

struct OpenScene;

// The picture of an open scene: while something moves as quick as its rate asks for, full soon after all
// rests, and from then on as it is.
class ScenePicture {
  public:
    struct Frame {
        int width, height;  // of the window, pixels
        double time;        // s, of the wall clock
        double seconds;     // that the last frame took, all in all
        double lineWidth;   // pixels, of springs and arrows
        bool moves;         // the run goes on, or the user does something
    };
    // `force`: full in any case. Error: a program cannot be made.
    void draw(OpenScene& open, const Frame& frame, bool force);
    bool rests() const { return rests_ && full_; }
    bool missesRate();  // at the least that there is; says so once

    FrameRate rate;

  private:
    void drawAt(OpenScene& open, const Frame& frame, const PictureLevel& level);

    // The view that is seen, beside what the user changes.
    struct Seen {
        View view;
        int width = 0, height = 0, builds = 0;
        bool operator==(const Seen&) const = default;
    };
    Seen seen_;
    double movedAt_ = 0;                 // s
    double drawing_ = 0;                 // s, of the last picture, at the most
    bool rests_ = false, full_ = false;  // nothing moves; the picture does without nothing
    bool counts_ = false;                // the last frame, for the rate
    bool told_ = false;
};

struct OpenScene {
    RunRequest request;  // what this scene was started with
    RunningScene running;
    Controls controls;
    ScenePicture picture;
    Panel panel;
    ScenePanel scenePanel;
    OrbitCamera camera;
    HotReload reload;
    TimeLine timeLine;
    std::unique_ptr<Explanations> explanations;
    std::unique_ptr<measure::Diagnostics> diagnostics;  // null: none are wanted
    std::optional<MoleculeNumbers> numbers;             // of the picked molecule, as read last
    bool follows = false;                               // the camera, the picked molecule

    // Error: RunningScene's; what --resume and --save name cannot be read or written.
    OpenScene(RunRequest given, gpu::Context& context, Loaded loaded, int width, int height);
    OpenScene(const OpenScene&) = delete;  // the running scene refers to the request
    OpenScene& operator=(const OpenScene&) = delete;

    Simulation& simulation() { return running.simulation(); }
    const Simulation& simulation() const { return running.simulation(); }
    void follow();  // after the scene was changed
    // What the sliders multiply becomes the scene's own. Error: RunningScene's; nothing has changed.
    void writeControls();
    bool unsaved() const { return running.document().unsaved() || scenePanel.drafted(); }
    // Saves what --save names: at the frames of --save-frames as the run passes them, else once at its end.
    void saveIfAsked(bool end);
    // Saves a state that ran away; returns the sentence that tells the user.
    std::string saveForInspection(const Runaway& runaway) const;

    // The molecule under the pointer, or none any more. `height`: of the window, pixels.
    void pick(int height);
    void forget();      // what was picked
    void readPicked();  // its numbers, and moves the camera that follows it
    // Its numbers, from `left` on and `bottom` above the window's bottom (in the interface's units), and a
    // ring around it.
    void drawPicked(float left, float bottom);
    std::vector<Warning> warnings() const;  // of the scene as it runs
    View view() const;                      // of now

  private:
    void diagnose();  // from now on

    int builds_ = 1;  // of `running`, that were followed
};

// Where the pointer is on a plane through what the camera looks at.
glm::dvec3 underPointer(const View& view);

// Handles the pointer on the picture of a scene: it turns, moves and zooms the camera, picks a molecule, and
// holds the forces that follow the mouse.
class ScenePointer {
  public:
    // Forces of the mouse act while Shift and the left button are held: where the pointer is, at the distance
    // of what the camera looks at.
    static void holdForces(OpenScene& open);

    // Between begin and end of the interface's frame. `height`: of the window, pixels.
    void move(OpenScene& open, int height);

  private:
    std::optional<ImVec2> pressedAt_;  // where the left button went down
};

}  // namespace shoal::window
