// The interactive viewer: a scene that runs, a camera to move, and the panels; or a list of scenes to choose
// from.
#pragma once

#include <optional>
#include <string>

#include "run/request.h"
#include "window/window_loop.h"

namespace shoal::window {

struct ViewerOptions {
    WindowOptions window;
    RunRequest run;      // of the first scene; how it is solved is meant of all that are opened later
    std::string folder;  // of the scenes to choose from
};

// Until the user closes the window, or after the frames that were asked for. Without a scene it lists those
// to choose from.
void runViewer(const ViewerOptions& options, gpu::Context& context, std::optional<Loaded> loaded);

}  // namespace shoal::window
