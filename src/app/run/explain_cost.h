// The report of `shoal explain --cost`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/line/commands.h"
#include "bench/machine.h"
#include "bench/rates.h"
#include "compile/cost.h"

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

}  // namespace shoal::app
