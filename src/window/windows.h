// The two windows: the viewer of scenes and the editor of molecules.
#pragma once

#include <optional>
#include <string>

#include "gpu/context.h"
#include "run/request.h"

namespace shoal::window {

struct WindowOptions {
    int width = 1280, height = 720;  // in screen units
    std::optional<double> scale;     // of the panels; nothing: as the window's screen asks for
    std::optional<int> frames;       // to be shown, then it closes
    std::string screenshot;          // a PNG of the window, panels and all, as it is when it closes
};

struct ViewerOptions {
    WindowOptions window;
    RunRequest run;      // of the first scene; of those that are opened later, only the execution path
    std::string folder;  // of the scenes to choose from
    bool edits = false;  // the panel shows all that the scene says
};

// Shows a scene that runs, a camera to move, and the panels, until the user closes the window or after the
// frames that were asked for. Without a scene it lists those to choose from.
void runViewer(const ViewerOptions& options, gpu::Context& context, std::optional<Loaded> loaded);

// Makes a window in which the molecule of a file is edited while it moves, until the user closes it. Where
// there is no file it begins as the shape of that name (author/shapes.h; empty: the first), and saving makes
// the file. Error: the file's, or there is no window to be had.
void runEditor(const std::string& file, const std::string& shape, const WindowOptions& options);

}  // namespace shoal::window
