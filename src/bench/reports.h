// The reports of `shoal bench`, as tables and plain sentences, or as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/collide.h"
#include "bench/machine.h"
#include "bench/particles.h"
#include "bench/sort.h"

namespace shoal::bench {

constexpr int pictureWidth = 640, pictureHeight = 360;

JsonValue asJson(const std::vector<Target>& targets);
// The table of the targets in a report's JSON; without `whole` of those that were measured.
std::string targetText(const JsonValue& report, bool whole = true);

// Says what there was no time for; nothing where there was time for all.
std::string leftOutText(const std::vector<std::string>& leftOut);

struct BenchReport {
    MeasuredOn machine;
    bool quick = false;
    bool whole = true;  // everything was asked for
    double secondsAGroup = 0;
    double seconds = 0;         // the whole run
    double contextSeconds = 0;  // to make the context
    std::vector<BenchResult> results;
    std::vector<BenchError> errors;
    std::vector<StartTime> starts;
    std::vector<PassTable> passes;
    std::vector<std::string> leftOut = {};  // groups and other parts for which there was no time
};

std::string asText(const BenchReport& report);
JsonValue asJson(const BenchReport& report);

struct CollideReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<ContactTimes> contact;
    std::optional<SearchReport> searches;
};

std::string asText(const CollideReport& report);
JsonValue asJson(const CollideReport& report);

struct ParticleReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<ParticleTimes> times;
    std::vector<std::string> leftOut = {};  // groups for which there was no time
};

std::string asText(const ParticleReport& report);
JsonValue asJson(const ParticleReport& report);

struct SortReport {
    MeasuredOn machine;
    double secondsASize = 0;
    std::vector<SortTable> tables;
};

std::string asText(const SortReport& report);
JsonValue asJson(const SortReport& report);

std::string asText(const MeasuredOn& machine, const std::vector<SchoolTimes>& all);
JsonValue asJson(const MeasuredOn& machine, const std::vector<SchoolTimes>& all);

}  // namespace shoal::bench
