// A scene that is open in the window, and all that the user moves of it.
#pragma once

#include "window/explanations.h"
#include "window/hot_reload.h"
#include "window/orbit_camera.h"
#include "window/panel.h"
#include "window/running_scene.h"
#include "window/scene_panel.h"

namespace shoal::window {

struct OpenScene {
    RunRequest request;  // what this scene was started with
    RunningScene running;
    Controls controls;
    Panel panel;
    ScenePanel scenePanel;
    OrbitCamera camera;
    HotReload reload;
    std::unique_ptr<Explanations> explanations;
    std::optional<MoleculeNumbers> numbers;  // of the picked molecule, as read last
    bool follows = false;                    // the camera, the picked molecule

    // Error: RunningScene's; what --resume and --save name cannot be read or written.
    OpenScene(RunRequest given, gpu::Context& context, gpu::ProgramCache& cache, Loaded loaded, int width,
              int height);
    OpenScene(const OpenScene&) = delete;  // the running scene refers to the request
    OpenScene& operator=(const OpenScene&) = delete;

    Simulation& simulation() { return running.simulation(); }
    const Simulation& simulation() const { return running.simulation(); }
    void follow();  // after the scene was built anew
    // Saves what --save names: at the frames of --save-frames as the run passes them, else once at its end.
    void saveIfAsked(bool end) const;
    // Saves a state that ran away; returns the sentence that tells the user.
    std::string saveForInspection(const Runaway& runaway) const;

    // The molecule under a place of the picture, in [0, 1] from the upper left corner; or none any more.
    void pick(const glm::dvec2& place, double aspect, int height);
    void forget();      // what was picked
    void readPicked();  // its numbers, and moves the camera that follows it
    // Its numbers, from `left` on (in the interface's units) at the bottom of the window, and a ring around
    // it. `aspect`: of the window, its width by its height.
    void drawPicked(double aspect, float left);
    View view() const;                   // of now
    void drawPicture(double lineWidth);  // pixels, of springs and arrows
};

}  // namespace shoal::window
