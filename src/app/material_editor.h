// Sliders for the looks of one group of molecules.
#pragma once

#include "app/running_scene.h"

namespace shoal::app {

// Whether the user changed `group` in this frame. Colours are the scene's and are saved; what the molecule's
// file says is changed for this run only, in `choice`.
bool drawMaterial(Group& group, GroupChoice& choice);

}  // namespace shoal::app
