// The keys of the viewer, for its help.
#pragma once

#include "window/notices.h"

namespace shoal::window {

constexpr HelpRow keysHelp[] = {
    {"left drag", "turn the camera"},
    {"right or middle drag", "move it"},
    {"wheel", "nearer, farther"},
    {"click", "pick a molecule, read its numbers"},
    {"Shift + left button", "forces that follow the mouse"},
    {"Space", "pause, go on"},
    {".", "one step"},
    {"R", "restart"},
    {"1, 2, 3", "from the front, the side, the top"},
    {"4, C", "the scene's own camera"},
    {"5", "follow the picked molecule"},
    {"X", "springs by their strain"},
    {"F", "arrows of the fluid's velocity"},
    {"H", "hide the panels, show them"},
    {"T", "a time line, to go back on"},
    {"O", "open another scene"},
    {"Ctrl + S", "save what was edited"},
    {"Ctrl + Z, Ctrl + Y", "take a change back, do it again"},
    {"P", "picture, numbered, in the working folder"},
    {"V", "record a video, stop"},
    {"F1, ?", "these keys"},
    {"Escape", "close what is on top, at last the window"},
    {nullptr, nullptr},
};

}  // namespace shoal::window
