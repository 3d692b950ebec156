#include "app/checkpoints.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/file.h"
#include "simulate/checkpoint.h"

namespace shoal::app {

std::string numbered(const std::string& target, int frame, bool several) {
    if (!several) return target;
    const std::filesystem::path path(target);
    char number[16];
    std::snprintf(number, sizeof number, "-%05d", frame);
    return (path.parent_path() / (path.stem().string() + number + path.extension().string())).string();
}

bool asksFor(const std::vector<int>& frames, int frame, int last) {
    return frames.empty() ? frame == last : std::find(frames.begin(), frames.end(), frame) != frames.end();
}

void checkFrames(const char* option, const std::vector<int>& frames, int first, int last) {
    for (const int frame : frames) {
        if (frame > last) throw Error(concat(option, ": frame ", frame, " is beyond the last, ", last));
        if (frame < first)
            throw Error(concat(option, ": frame ", frame, " is before ", first, ", where the run goes on"));
    }
}

void resume(const Options& options, Simulation& simulation) {
    if (options.resume.empty()) return;
    const Checkpoint from = readCheckpoint(options.resume, simulation.plan());
    simulation.load(from.state);
    simulation.parameters = from.parameters;
}

void checkSave(const Options& options) {
    if (!options.save.empty()) FileWriter(options.save);  // made, and taken away again
}

void saveState(const std::string& file, const Simulation& simulation) {
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
}

}  // namespace shoal::app
