#include "run/checkpoints.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/file.h"
#include "simulate/checkpoint.h"

namespace shoal {

namespace fs = std::filesystem;

std::string numbered(const std::string& target, int frame, bool several, int last) {
    if (!several) return target;
    const fs::path path(target);
    const std::string number = formatted("-%0*d", std::max(5, int(std::to_string(last).size())), frame);
    return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

bool contains(const std::vector<int>& frames, int frame) {
    return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

void resume(const RunRequest& request, Simulation& simulation) {
    if (request.resume.empty()) return;
    const Checkpoint from = readCheckpoint(request.resume, simulation.plan());
    simulation.load(from.state);
    simulation.parameters = from.parameters;
}

void checkSave(const RunRequest& request) {
    if (!request.save.empty()) checkWritable(request.save);
}

void saveState(const std::string& file, Simulation& simulation) {
    simulation.check();
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
}

std::string sceneStem(const std::string& file) {
    const std::string stem = fs::path(file).filename().string();
    return stem.substr(0, stem.find('.'));
}

std::string saveForInspection(const std::string& folder, const std::string& sceneFile,
                              const Simulation& simulation, const Runaway& runaway) {
    const std::optional<SavedState> before = simulation.saveBefore();
    const SavedState state = before ? *before : simulation.save();
    if (!findAlarm(state).finite)
        return concat("The state before is gone; to have it, run again with --frames ",
                      std::max(1, runaway.alarm().frame - 1), " and --save");
    const std::string file = (fs::path(folder) / (sceneStem(sceneFile) + ".watchdog.shoal")).string();
    try {
        writeCheckpoint(file, simulation.plan(), {state, simulation.parameters});
    } catch (const Error& error) {
        return concat("The state could not be saved: ", error.what());
    }
    return concat("Look closer with --resume ", file, ", the state at frame ", state.frames);
}

}  // namespace shoal
