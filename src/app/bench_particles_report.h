// The report of `shoal bench particles`, as tables or JSON.
#pragma once

#include <string>
#include <vector>

#include "app/machine.h"
#include "bench/particles.h"
#include "core/json.h"

namespace shoal::app {

struct ParticleReport {
    MeasuredOn machine;
    double secondsAGroup = 0;
    std::vector<bench::ParticleTimes> times;
};

std::string asText(const ParticleReport& report);
JsonValue asJson(const ParticleReport& report);

}  // namespace shoal::app
