// A scene that is open in the window, and all that the user moves of it.
#pragma once

#include "app/hot_reload.h"
#include "app/orbit_camera.h"
#include "app/panel.h"
#include "app/running_scene.h"
#include "app/scene_panel.h"

namespace shoal::app {

struct OpenScene {
    Options options;  // what this scene was started with
    RunningScene running;
    Controls controls;
    Panel panel;
    ScenePanel scenePanel;
    OrbitCamera camera;
    HotReload reload;

    // Error: RunningScene's; what --resume and --save name cannot be read or written.
    OpenScene(Options given, gpu::Context& context, gpu::ProgramCache& cache, Loaded loaded, int width,
              int height);
    OpenScene(const OpenScene&) = delete;  // the running scene refers to the options
    OpenScene& operator=(const OpenScene&) = delete;

    Simulation& simulation() { return running.simulation(); }
    void follow();  // after the scene was built anew
};

}  // namespace shoal::app
