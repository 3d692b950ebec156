// Whether a device computes what it should: the checks of `shoal bench --report`.
//
//   state    a scene, or a solver, against the stored state (bench/stored_states.h)
//   agree    one frame from the same state on two execution paths, or in two forms of the kernel
//   repeat   the same run twice ends in the same bits
//
// A check that fails, whatever its reason, is a row with its words, and the next one goes on.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/stored_states.h"

namespace shoal::bench {

struct DeviceCheck {
    std::string kind, name;
    // Error: the driver's, or why it cannot be done; LeftOut: this context lacks what it takes.
    std::function<Mismatch()> run;

    std::string title() const { return kind + ": " + name; }
};

// Why a check is not for this context.
class LeftOut : public Error {
    using Error::Error;
};

struct DeviceCheckResult {
    std::string kind, name;
    Mismatch mismatch;    // where it ran
    std::string leftOut;  // why it did not
    std::string failed;   // the words of an error
    double seconds = 0;
    bool held() const { return failed.empty() && leftOut.empty() && mismatch.ofTolerance <= 1; }
};

// Runs a check. Throws only gpu::DeviceLost.
DeviceCheckResult runCheck(const DeviceCheck& check, gpu::Context& context);

// A scene's name on the command line and its file.
using NamedFile = std::pair<std::string, std::string>;

// The scene of a file with at most 1,000 molecules a group, and places for four times as many: enough to be
// wrong, and a CPU rasteriser takes seconds.
Scene checkedScene(const std::string& file);
constexpr int checkedFrames = 60, solverFrames = 30;

// A name and a scene for each solver, whose states are stored beside those of the scenes.
std::vector<std::pair<std::string, Scene>> solverScenes(const std::string& moleculeFolder);

// All of them. `scenes`: those that ship. Borrows `device` and `stored`.
std::vector<DeviceCheck> deviceChecks(const std::vector<NamedFile>& scenes, const std::string& moleculeFolder,
                                      const StoredStates& stored, const BenchDevice& device);

}  // namespace shoal::bench
