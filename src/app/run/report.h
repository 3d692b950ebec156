// The report of `run --json`.
#pragma once

#include <string>
#include <vector>

#include "bench/machine.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Births and deaths of a group until now.
struct GroupLives {
    std::string group;
    LifeCounts counts;
    Allocator allocator = Allocator::gpu;
};

struct RunReport {
    std::string scene;
    double seconds = 0;                // wall-clock time of the frames
    gpu::Traffic start;                // bytes moved before the first frame
    gpu::Traffic frames;               // by the frames alone: simulate and draw
    gpu::Traffic outside;              // by captures, exports, diagnostics and the final hash
    std::vector<std::string> written;  // pictures, videos, exports
    std::vector<GroupLives> lives;     // at the end, of groups with life
};

std::vector<GroupLives> livesOf(const Simulation& simulation);
std::string text(const GroupLives& lives);  // "drops: 512 of 600 places taken, 2048 born"

JsonValue asJson(const RunReport& report, Simulation& simulation, const std::vector<gpu::PassTime>& times,
                 uint64_t hash);

}  // namespace shoal::app
