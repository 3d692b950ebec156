// The description of the machine in reports of times.
#pragma once

#include <string>

#include "core/json.h"
#include "gpu/context.h"

namespace shoal::app {

std::string processorName();

// Where a benchmark ran.
struct MeasuredOn {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
};
MeasuredOn measuredOn(const gpu::Context& context);  // none pinned
std::string asText(const MeasuredOn& machine);       // one line, without its end
std::string twoLines(const MeasuredOn& machine);     // without the second one's end
JsonValue headOf(const MeasuredOn& machine);         // the first keys of a report
JsonValue asJson(const gpu::ContextInfo& context);

}  // namespace shoal::app
