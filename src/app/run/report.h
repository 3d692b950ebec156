// Reports share these: the machine, the passes' times; and the report of `run --json`.
#pragma once

#include <string>
#include <vector>

#include "core/json_build.h"
#include "gpu/context.h"
#include "measure/timing.h"
#include "simulate/simulation.h"

namespace shoal::app {

// The device's own time of a case (bench/bench.h): its two keys, null without samples.
void appendDeviceTime(JsonValue& out, const measure::Spread& device);

// ---- The machine

std::string processorName();

// Where a benchmark ran.
struct MeasuredOn {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
};
MeasuredOn measuredOn(const gpu::Context& context);  // none pinned
std::string asText(const MeasuredOn& machine);       // one line, without its end
JsonValue headOf(const MeasuredOn& machine);         // the first keys of a report
JsonValue asJson(const gpu::ContextInfo& context);

// ---- Runs

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
    gpu::Traffic outside;              // by captures, exports and the final hash
    std::vector<std::string> written;  // pictures, videos, exports
    std::vector<GroupLives> lives;     // at the end, of groups with life
};

std::vector<GroupLives> livesOf(const Simulation& simulation);
std::string text(const GroupLives& lives);  // "drops: 512 of 600 places taken, 2048 born"

JsonValue asJson(const gpu::PassTime& pass);
JsonValue asJson(const RunReport& report, Simulation& simulation, const std::vector<gpu::PassTime>& times,
                 uint64_t hash);

}  // namespace shoal::app
