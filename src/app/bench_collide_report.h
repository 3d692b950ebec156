// The report of `shoal bench collide`, as tables or JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/machine.h"
#include "bench/collide.h"
#include "bench/search.h"
#include "bench/uberflow.h"
#include "core/json.h"

namespace shoal::app {

struct CollideReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ContactTimes> contact;
    std::vector<bench::UberFlowTimes> uberFlow;
    std::optional<bench::SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

}  // namespace shoal::app
