// The window as the user sees it, panels and all.
#pragma once

#include <string>

namespace shoal::app {

// What is in the window's framebuffer now, as a PNG; says so on standard output. Error: cannot be written.
void saveScreenshot(const std::string& file, int width, int height);

}  // namespace shoal::app
