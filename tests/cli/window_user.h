// A user of a real window, moved by xdotool while the program runs. Needs a display.
#pragma once

#include <string>

#include "cli/shoal_command.h"

namespace shoal::test {

bool hasXdotool();  // says once that it is not there

// Runs the program, which opens a window, and does `steps` in it, a shell script; places are in pixels of the
// window. No step waits for a time: each waits until the window has taken what was done, or for what it
// names, and fails after a minute. What it can say besides what a shell can:
//
//     at X Y, press X Y, drag X Y TO-X    the pointer, its left button
//     key NAME, control NAME              keys as xdotool names them
//     settle                              all that was done is taken, and drawn
//     says TEXT [TIMES]                   the program has written TEXT into as many lines, 1 unless told
//     await CONDITION                     any other
//     inOneFrame STEPS                    as on a machine so slow that all of it falls into one frame
//     close                               Escape until the program ends
Outcome inWindow(const Words& arguments, const std::string& steps, const Surroundings& surroundings = {});

}  // namespace shoal::test
