// Schools: what `shoal bench school` measures. Fry that swim with their muscles and school at a fixed
// density, 1,000 to 100,000 of them, and beside them as many that only swim; simulate only. Cases take turns;
// none starts over between its samples, so that they are in motion.
#pragma once

#include <vector>

#include "bench/bench.h"
#include "bench/runner.h"
#include "measure/statistics.h"

namespace shoal::bench {

struct SchoolCase {
    int count = 1000;
    bool schools = true;
};

constexpr double schoolDensity = 100;  // fish a m^3

std::vector<SchoolCase> schoolCases(bool quick);
Scene schoolScene(const SchoolCase& one, const Molecule& fry);

struct SchoolTimes {
    SchoolCase one;
    measure::Spread frame;                                    // s
    double perFish() const { return frame.min / one.count; }  // s
};

// Error: a context below 4.3; the driver refuses a shader.
std::vector<SchoolTimes> measureSchools(const std::vector<SchoolCase>& cases, const Molecule& fry,
                                        const BenchDevice& device, double seconds);

}  // namespace shoal::bench
