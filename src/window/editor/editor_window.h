// `shoal edit`: a window to look at a molecule and change it, while it moves.
#pragma once

#include <string>

#include "window/window_loop.h"

namespace shoal::window {

// Makes a window of its own, so many pixels wide and high, and edits the molecule of a file in it until the
// user closes it. Error: the file's, or there is no window to be had.
void runEditor(const std::string& file, const WindowOptions& options, int width, int height);

}  // namespace shoal::window
