#include "app/checkpoints.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/file.h"
#include "simulate/checkpoint.h"

namespace shoal::app {

namespace fs = std::filesystem;

std::string numbered(const std::string& target, int frame, bool several, int last) {
    if (!several) return target;
    const fs::path path(target);
    char number[16];
    std::snprintf(number, sizeof number, "-%0*d", std::max(5, int(std::to_string(last).size())), frame);
    return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

bool contains(const std::vector<int>& frames, int frame) {
    return std::find(frames.begin(), frames.end(), frame) != frames.end();
}

void checkFrames(const char* option, const std::vector<int>& frames, int first, int last) {
    for (const int frame : frames) {
        if (frame > last) throw WrongUse(concat(option, ": frame ", frame, " is beyond the last, ", last));
        if (frame < first)
            throw WrongUse(
                concat(option, ": frame ", frame, " is before ", first, ", where the run goes on"));
    }
}

void resume(const Options& options, Simulation& simulation) {
    if (options.resume.empty()) return;
    const Checkpoint from = readCheckpoint(options.resume, simulation.plan());
    simulation.load(from.state);
    simulation.parameters = from.parameters;
}

void checkSave(const Options& options) {
    if (!options.save.empty()) checkWritable(options.save);
}

void saveState(const std::string& file, const Simulation& simulation) {
    simulation.check();
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
}

// The folder of what a run writes.
static fs::path outputFolder(const Options& options) {
    if (!options.save.empty()) return fs::path(options.save).parent_path();
    const std::string target = options.capture.empty() ? options.exports : options.capture;
    return lowerExtension(target).empty() ? fs::path(target) : fs::path(target).parent_path();
}

std::string sceneStem(const std::string& file) {
    const std::string stem = fs::path(file).filename().string();
    return stem.substr(0, stem.find('.'));
}

std::string saveForInspection(const Options& options, const Simulation& simulation, const Runaway& runaway) {
    const std::optional<SavedState> before = simulation.saveBefore();
    const SavedState state = before ? *before : simulation.save();
    if (!findAlarm(state).finite)
        return concat("The state before is gone; to have it, run again with --frames ",
                      std::max(1, runaway.alarm().frame - 1), " and --save");
    const std::string file =
        (outputFolder(options) / (sceneStem(options.files.front()) + ".watchdog.shoal")).string();
    try {
        writeCheckpoint(file, simulation.plan(), {state, simulation.parameters});
    } catch (const Error& error) {
        return concat("The state could not be saved: ", error.what());
    }
    return concat("Look closer with --resume ", file, ", the state at frame ", state.frames);
}

}  // namespace shoal::app
