// Where something was measured, and what reports say of it and of times.
#pragma once

#include <string>

#include "core/json_build.h"
#include "gpu/context.h"
#include "gpu/pass_timers.h"
#include "measure/timing.h"

namespace shoal::bench {

std::string processorName();

struct MeasuredOn {
    std::string version, processor;  // version: ours
    int cores = 1, pinned = 0;       // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
};
MeasuredOn measuredOn(const gpu::Context& context, const std::string& version);  // none pinned
std::string asText(const MeasuredOn& machine);                                   // one line, without its end
JsonValue headOf(const MeasuredOn& machine);                                     // the first keys of a report

JsonValue asJson(const gpu::ContextInfo& context);
JsonValue asJson(const gpu::PassTime& pass);
// Adds the device's own time of a case (bench/bench.h): two keys, null without samples.
void appendDeviceTime(JsonValue& out, const measure::Spread& device);

}  // namespace shoal::bench
