// Handles the pointer on the picture of a scene: it turns, moves and zooms the camera, picks a molecule, and
// holds the forces that follow the mouse.
#pragma once

#include <optional>

#include <imgui.h>

#include "window/open_scene.h"

namespace shoal::window {

class ScenePointer {
  public:
    // Forces of the mouse act while Shift and the left button are held: where the pointer is, at the distance
    // of what the camera looks at. `aspect`: of the window, its width by its height.
    static void holdForces(OpenScene& open, double aspect);

    // Between begin and end of the interface's frame. `height`: of the window, pixels.
    void move(OpenScene& open, double aspect, int height);

  private:
    void pickOnClick(OpenScene& open, double aspect, int height);

    std::optional<ImVec2> pressedAt_;  // where the left button went down
};

}  // namespace shoal::window
