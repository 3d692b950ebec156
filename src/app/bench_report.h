// The report of `shoal bench`, as a table and plain sentences, or JSON.
#pragma once

#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/error.h"
#include "bench/passes.h"
#include "bench/start.h"
#include "bench/verdict.h"
#include "core/json.h"
#include "gpu/context.h"

namespace shoal::app {

struct BenchReport {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
    bool quick = false;
    bool whole = true;  // everything was asked for
    double secondsAGroup = 0;
    int width = 0, height = 0;  // of the pictures
    double seconds = 0;         // the whole run
    double contextSeconds = 0;  // to make the context
    std::vector<bench::BenchResult> results;
    std::vector<bench::BenchError> errors;
    std::vector<bench::StartTime> starts;
    std::vector<bench::PassTable> passes;
};

std::string asText(const BenchReport& report);
JsonValue asJson(const BenchReport& report);

}  // namespace shoal::app
