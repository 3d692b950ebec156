// The error of methods where paths part: how far their statistics (measure/ensemble.h) are from a
// reference's, over runs that differ in their seeds.
//
// The reference is Runge-Kutta of order 4 in double precision where reference/problem.h knows all that acts
// on the molecules; one fixed step a molecule, halved until the statistics stay. Elsewhere it is leapfrog
// with many substeps on the device, beside half as many, which tell whether they are enough. Run i of every
// method and of the reference starts from the scene with its seed + i, to the bit of a float.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/accuracy.h"
#include "measure/ensemble.h"

namespace shoal::measure {

struct StatisticsOptions {
    int seeds = 32;                        // at least 2
    double duration = 1;                   // s of simulated time, rounded to whole frames
    std::optional<int> molecules = {};     // of each group that the reference in double precision
                                           // has; nothing: as many as time allows, 64 at most
    std::vector<SolverKind> solvers = {};  // empty: the scene's
    std::vector<int> substeps = {};        // each with each solver; empty: the scene's
    std::optional<double> seconds = {};    // of all of it, about: fewer molecules and seeds, at least two
    std::function<void(double share)> tell = [](double) {};  // of the whole that is done
};
constexpr int claimedSeeds = 30;  // fewer make no claim

struct StatisticsMethod {
    std::string solver;  // those of its groups
    int substeps = 0;
    Outcome outcome = Outcome::measured;
    std::string why;  // of a refusal, or when it blew up
    std::vector<Difference> differences;
    std::optional<size_t> worst;  // of them
    double within = 0;            // the largest share of a scale that an interval reaches
    Ensemble ensemble;
};

struct StatisticsReference {
    bool isDouble = false;  // precision, on the CPU; else it is a method on the device
    std::string solver;
    int substeps = 0;  // on the device
    double step = 0;   // s, the longest
    std::string why;   // it is on the device
    Ensemble ensemble;
    std::vector<Difference> halving;  // from twice the step to its own
    std::optional<size_t> worst;      // of these
    bool settled = false;             // what halving changes is below what is known of the statistics
};

struct StatisticsGroup {
    std::string name, molecule;
    int molecules = 0;  // at the start
    int vertices = 0;
};

struct StatisticsReport {
    std::string scene;
    double frameRate = 60, duration = 1;  // Hz, s
    uint64_t firstSeed = 1;
    int seeds = 0;  // that all methods had
    // Where the seed leaves the starts as they are: a share of each molecule's size by which it is displaced
    // in a random direction, and an angle in rad by which it is turned. Else 0.
    double displaced = 0;
    Path path = Path::fused;
    std::vector<StatisticsGroup> groups;
    StatisticsReference reference;
    std::vector<StatisticsMethod> methods;
    std::vector<std::string> notes;  // for people
    double seconds = 0;              // that it took
};

// Error: the scene has no groups, or nothing in it moves; no method can run it; the reference is not finite.
StatisticsReport measureStatistics(const Scene& scene, const StatisticsOptions& options,
                                   const AccuracyDevice& device);

}  // namespace shoal::measure
