#include "app/open_scene.h"

#include "app/checkpoints.h"

namespace shoal::app {

OpenScene::OpenScene(Options given, gpu::Context& context, gpu::ProgramCache& cache, Loaded loaded, int width,
                     int height)
    : options(std::move(given)),
      running(options, context, cache, std::move(loaded), width, height),
      controls(running.simulation().plan()),
      panel(running.original()),
      scenePanel(running.scene),
      camera(View::of(running.scene.camera)) {
    reload.follow(running, true);
    checkSave(options);
    if (options.resume.empty()) return;
    resume(options, running.simulation());
    controls.follow(running.simulation().parameters);
}

void OpenScene::follow() {
    controls.follow(simulation().plan());
    panel.follow(running.original());
    scenePanel.follow(running.scene);
    camera.start(View::of(running.scene.camera));
    reload.follow(running, false);
}

}  // namespace shoal::app
