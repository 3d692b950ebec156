// What `shoal bench` says: a table and plain sentences, or JSON.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "gpu/context.h"
#include "measure/bench.h"
#include "measure/bench_verdict.h"

namespace shoal::app {

struct BenchReport {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
    bool quick = false;
    double secondsAGroup = 0;
    int width = 0, height = 0;  // of the pictures
    double seconds = 0;         // the whole run
    std::vector<measure::BenchResult> results;
};

std::string asText(const BenchReport& report);
JsonValue asJson(const BenchReport& report);

}  // namespace shoal::app
