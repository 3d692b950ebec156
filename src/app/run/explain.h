// The parts of `shoal explain` that a device is asked for: --cost and --passes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/line/commands.h"
#include "bench/machine.h"
#include "bench/rates.h"
#include "compile/cost.h"
#include "gpu/frame_record.h"

namespace shoal::app {

struct SceneCost {
    bench::MeasuredOn machine;
    bool software = false;
    std::optional<bench::DeviceRates> rates;  // nothing below OpenGL 4.3
    std::vector<KernelCost> kernels;          // a group each
};

// Makes a context, whose limits choose path and form, and measures its rates where no file keeps them.
// WrongUse: the scene does not run on the fused path.
SceneCost sceneCost(const Options& options, const Loaded& loaded);
std::string asText(const SceneCost& cost);
JsonValue asJson(const SceneCost& cost);

struct FramePasses {
    bench::MeasuredOn machine;
    std::vector<gpu::PassRow> rows;
};

// Makes a context, and runs and draws the scene's second frame there: the first also makes what is made once.
FramePasses framePasses(const Options& options, const Loaded& loaded);
std::string asText(const FramePasses& passes);
JsonValue asJson(const FramePasses& passes);

}  // namespace shoal::app
