// The molecule that was picked: its numbers, and a ring around it.
#pragma once

#include "window/open_scene.h"

namespace shoal::window {

// Where one is picked, its numbers from `left` on (in the interface's units) at the bottom of the window.
// `aspect`: of the window, its width by its height.
void drawPicked(OpenScene& open, double aspect, float left);

}  // namespace shoal::window
