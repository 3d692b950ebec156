// `shoal explain --passes`: what one frame asks of this device, pass by pass.
#pragma once

#include <string>
#include <vector>

#include "app/line/commands.h"
#include "bench/machine.h"
#include "gpu/frame_record.h"

namespace shoal::app {

struct FramePasses {
    bench::MeasuredOn machine;
    std::vector<gpu::PassRow> rows;
};

// Makes a context, and runs and draws the scene's second frame there: the first also makes what is made once.
FramePasses framePasses(const Options& options, const Loaded& loaded);
std::string asText(const FramePasses& passes);
JsonValue asJson(const FramePasses& passes);

}  // namespace shoal::app
