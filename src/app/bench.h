// The reports of `shoal bench`, as tables, plain sentences, or JSON, and what its commands share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/report.h"
#include "bench/bench.h"
#include "bench/collide.h"
#include "bench/particles.h"

namespace shoal::app {

// Makes what draws the pictures of a benchmark. Borrows the context.
bench::DrawMaker drawMaker(gpu::Context& context);

// Targets as all but the plain `shoal bench` report them. `format`: of what was measured, as for std::printf.
std::string asText(const std::vector<bench::Target>& targets, const char* format);
JsonValue asJson(const std::vector<bench::Target>& targets);

struct BenchReport {
    MeasuredOn machine;
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

struct CollideReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ContactTimes> contact;
    std::vector<bench::UberFlowTimes> uberFlow;
    std::optional<bench::SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

struct ParticleReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ParticleTimes> times;
};

std::string asText(const ParticleReport& report);
JsonValue asJson(const ParticleReport& report);

}  // namespace shoal::app
