// The measurements of `shoal bench`: frames, errors, passes, the start, schools, and what is made of them.
//
// All cases of a group are measured in turn, round after round, so that a machine whose speed drifts drifts
// for all alike.
//
// A visit of a case: back to the start; a frame that is not timed, so that caches are as in a run of its own;
// then four frames between two waits, one sample. Frames above 0.1 s go without the first and are sampled one
// by one. So all samples of a case are the same frames of the fall, and those of different cases lie within
// the same five. Slow cases sit out rounds, evenly.
//
// Samples of a case differ only by what disturbs them: the shortest says what the work costs, and what is
// derived (ratios, bandwidth) goes by it; the median says what to expect. A case with few samples has had
// fewer chances of a short one: their number is in the report.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/case.h"
#include "bench/runner.h"
#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
#include "measure/timing.h"

namespace shoal::bench {

struct BenchResult {
    BenchCase benchCase;
    std::string leftOut = {};    // why it was not measured; empty: it was
    std::string failed = {};     // the words of an error, where BenchDevice::goesOn; empty: none
    bool mayFail = false;        // BenchDevice::goesOn
    measure::Spread frame = {};  // s, wall time
    // s, the device's own time of the same frames (gpu/pass_timers.h); no samples: a processor runs it.
    measure::Spread device = {};
    int framesPerSample = 1;
    size_t stateBytes = 0, movedBytes = 0;  // BenchRunner's
    double operations = 0;                  // BenchRunner's
    double busStateBytes = 0;               // a frame: state that crossed the bus
    Lanes lanes = Lanes::automatic;
    double perMolecule() const { return frame.min / benchCase.count; }  // s, by the shortest
};

// Reports the share of the work that is done, in [0, 1].
using BenchProgress = std::function<void(double share)>;

// Cases of one group: same molecule and count. Error: the driver refuses a shader.
std::vector<BenchResult> measureGroup(const std::vector<BenchCase>& cases, const BenchMolecules& molecules,
                                      const BenchDevice& device, const measure::Schedule& schedule,
                                      const BenchProgress& progress);

// Whether a part that is expected to take so many seconds ends by `most`, at the pace of the parts before it:
// these were expected to take `expected` s, and took `elapsed` s.
bool fitsAtPace(double seconds, double expected, double elapsed, double most);

// The cases of a list by their groups, in the order of the list.
template <typename Case>
std::vector<std::vector<Case>> byGroup(const std::vector<Case>& cases) {
    std::vector<std::vector<Case>> out;
    for (const Case& benchCase : cases) {
        if (out.empty() || out.back().front().group != benchCase.group) out.emplace_back();
        out.back().push_back(benchCase);
    }
    return out;
}

// Measures in turn what is not left out. make(result) gives a pointer to what measures it: it has warmUp(),
// the seconds of a visit after that, visit(), and finish(), which writes the times into the result. A case
// that the device has no memory for is left out. An error ends the measurement, unless the result may record
// it.
template <typename Result, typename Make>
void measureInTurn(std::vector<Result>& results, const measure::Schedule& schedule,
                   const BenchProgress& progress, const Make& make) {
    std::vector<decltype(make(results.front()))> entrants;
    std::vector<double> cost;
    for (Result& result : results) {
        progress(0);
        if (!result.leftOut.empty()) continue;
        try {
            auto entrant = make(result);
            measure::pinRasteriserThreads();
            entrant->warmUp();
            cost.push_back(entrant->seconds);
            entrants.push_back(std::move(entrant));
        } catch (const gpu::OutOfMemory& error) {
            result.leftOut = error.message();
        } catch (const Error& error) {
            if constexpr (requires { result.failed; })
                if (result.mayFail) {
                    result.failed = error.what();
                    continue;
                }
            throw;
        }
    }
    const measure::VisitPlan plan = measure::planVisits(cost, schedule);
    double done = 0;
    measure::takeTurns(plan, [&](size_t i) {
        entrants[i]->visit();
        done += cost[i];
        progress(done / plan.seconds);
    });
    for (const auto& entrant : entrants)
        entrant->finish();
}

// ---- Errors
// The error that a speed buys: quads spinning in the air, after 1 s at the benchmark's step, against the
// double-precision reference.

struct BenchError {
    Subject subject = Subject::fused;
    SolverKind solver = SolverKind::euler;
    Wind wind = Wind::uniform;
    FieldSampling sampling = FieldSampling::vertexSubstep;
    // RMS distance of the vertices over the molecule's size, RMS over the molecules. Nothing: the reference
    // does not converge, or the context lacks the path.
    std::optional<double> relative;
};

// `count`: molecules.
std::vector<BenchError> measureErrors(const BenchMolecules& molecules, const BenchDevice& device, int count,
                                      const BenchProgress& progress);

// ---- Passes
// Time per pass, from the passes' own timers: queries on a GPU, waits and a clock on a CPU rasteriser.

struct PassTable {
    int count = 0;  // quads
    Subject subject = Subject::fused;
    SolverKind solver = SolverKind::euler;
    std::vector<gpu::PassTime> passes;
    measure::Spread frame;  // s, wall-clock, with the timers in it
};

// Quads that are drawn, so that normals are computed, without a picture; round after round for `seconds`.
std::vector<PassTable> measurePasses(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                     double seconds, const BenchProgress& progress);

// ---- Start
// How long it takes from nothing to the first frame.

// Seconds. The last three are of making a Simulation and its first frame, waited for:
struct StartTime {
    std::string molecule;
    SolverKind solver = SolverKind::euler;
    int count = 0;
    double compile = 0;  // scene to plan
    double cold = 0;     // a kernel that neither our cache nor the driver's has seen
    double driver = 0;   // the driver's own cache may know it
    double cached = 0;   // our cache has it, too
};

// Makes a folder for a cache of its own and removes it. Empty below OpenGL 4.3.
std::vector<StartTime> measureStart(const BenchMolecules& molecules, const BenchDevice& device, bool quick,
                                    const BenchProgress& progress);

// ---- Verdict, pure: ratios between cases, and whether the project's targets hold

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

// ---- Schools
// `shoal bench school` measures fry that swim with their muscles and school at a fixed
// density, 1,000 to 100,000 of them, and beside them as many that only swim; simulate only. Cases take turns;
// none starts over between its samples, so that they are in motion.

struct SchoolCase {
    int count = 1000;
    bool schools = true;
    Path path = Path::fused;
};

constexpr double schoolDensity = 100;  // fish a m^3

std::vector<SchoolCase> schoolCases(bool quick, bool software);
Scene schoolScene(const SchoolCase& schoolCase, const Molecule& fry);

struct SchoolTimes {
    SchoolCase benchCase;
    std::string leftOut = {};                                       // why it was not measured; empty: it was
    measure::Spread frame = {};                                     // s, wall time
    measure::Spread device = {};                                    // s, as BenchResult's
    double perFish() const { return frame.min / benchCase.count; }  // s
};

// A case that the device has no memory for is left out. Error: the driver refuses a shader.
std::vector<SchoolTimes> measureSchools(const std::vector<SchoolCase>& cases, const Molecule& fry,
                                        const BenchDevice& device, const measure::Schedule& schedule);

}  // namespace shoal::bench
