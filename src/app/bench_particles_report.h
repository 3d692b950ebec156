// What `shoal bench particles` says: tables, or JSON.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "gpu/context.h"
#include "measure/bench_particles.h"

namespace shoal::app {

struct ParticleReport {
    std::string processor;
    int cores = 1, pinned = 0;  // pinned: workers of a CPU rasteriser
    gpu::ContextInfo context;
    double secondsAGroup = 0;
    std::vector<measure::ParticleTimes> times;
};

std::string asText(const ParticleReport& report);
JsonValue asJson(const ParticleReport& report);

}  // namespace shoal::app
