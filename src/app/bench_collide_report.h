// What `shoal bench collide` says: tables, or JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/machine.h"
#include "core/json.h"
#include "measure/bench_collide.h"
#include "measure/bench_search.h"
#include "measure/bench_uberflow.h"

namespace shoal::app {

struct CollideReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<measure::ContactTimes> contact;
    std::vector<measure::UberFlowTimes> uberFlow;
    std::optional<measure::SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

}  // namespace shoal::app
