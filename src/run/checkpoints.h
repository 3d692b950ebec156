// --save, --save-frames, --resume and what the watchdog leaves, of runs without and with a window.
#pragma once

#include <string>
#include <vector>

#include "run/request.h"
#include "simulate/simulation.h"

namespace shoal {

// Where a frame's file goes: "out.csv" becomes "out-00060.csv" where several frames are asked for. Numbers
// are as long as `last`, so that names sort.
std::string numbered(const std::string& target, int frame, bool several, int last);

// "hello" of "models/hello/hello.scene.json".
std::string sceneStem(const std::string& file);

bool contains(const std::vector<int>& frames, int frame);

// Goes on from the file that --resume names; without it nothing happens. Error: readCheckpoint's.
void resume(const RunRequest& request, Simulation& simulation);

// Error: it could not be written at the end of the run either. Makes its folder.
void checkSave(const RunRequest& request);
// Writes the state as it is. Runaway: it is none to go on from; an older file is kept. Error: cannot be
// written.
void saveState(const std::string& file, Simulation& simulation);

// Saves what can be looked at closer, as <scene>.watchdog.shoal in a folder (empty: the working directory):
// the state before the frame that went wrong, or as it is, where that is finite. Returns a sentence that says
// so, or why there is none.
std::string saveForInspection(const std::string& folder, const std::string& sceneFile,
                              const Simulation& simulation, const Runaway& runaway);

}  // namespace shoal
