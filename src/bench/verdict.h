// Judges the times of a run: ratios between cases, and whether the project's targets hold. Pure.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/error.h"

namespace shoal::bench {

// Ratios of the shortest times; nothing where there is nothing to compare with in the case's group.
struct Ratios {
    std::optional<double> avx512, avx2;  // the case's time over that baseline's
    std::optional<double> pingPong;      // the ping-pong path's time over the case's: how much faster it is
    std::optional<double> bandwidth;     // B/s: bytes moved over time
    std::optional<double> shareOfCopy;   // of the fastest copy of as many bytes on the same device
    std::optional<double> arithmetic;    // operations a second, about
    std::optional<double> shareOfPeak;   // of what multiply-adds alone reach on the same device
};
Ratios ratiosOf(const BenchResult& result, const std::vector<BenchResult>& all);

struct Target {
    std::string what;
    double limit = 0;
    bool atLeast = false;                 // else at most
    std::optional<double> measured = {};  // of the shortest times; nothing: this run has not what it takes
    std::string unit = "x";               // or "bytes"
    std::optional<double> ofMedians = {};
    bool holds() const { return measured && (atLeast ? *measured >= limit : *measured <= limit); }
};
// `software`: a CPU rasteriser, for which the share of a GPU's bandwidth is no target.
std::vector<Target> targets(const std::vector<BenchResult>& all, bool software);

// The case that says how fast `count` quads run with what an error was measured of; null without one.
const BenchResult* speedOf(const BenchError& error, int count, const std::vector<BenchResult>& all);

// How near the fused path comes to what the device can move and compute, where both were measured; for
// people.
std::vector<std::string> distances(const std::vector<BenchResult>& all);

// How many cases took much longer by the median than by the shortest time: something else was running.
int disturbed(const std::vector<BenchResult>& all);

// One line for people: what was wanted, what was measured.
std::string sentence(const Target& target);

}  // namespace shoal::bench
