// What `shoal bench collide` says: tables, or JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "gpu/context.h"
#include "measure/bench_collide.h"
#include "measure/bench_search.h"
#include "measure/bench_uberflow.h"

namespace shoal::app {

struct CollideReport {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
    double secondsAGroup = 0;
    std::vector<measure::ContactTimes> contact;
    std::vector<measure::UberFlowTimes> uberFlow;
    std::optional<measure::SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

}  // namespace shoal::app
