// Measures what an error costs: a scene is run by every method, at every step and field sampling, on the real
// path in float, and compared with the double-precision reference.
//
// The error is measured on a few molecules of each group, where the reference tells; the time on as many as
// the scene has, because few do not fill a device. Both start from the same state, to the bit of a float.
// Pins that may be released are held throughout.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"
#include "measure/timing.h"

namespace shoal::measure {

enum class Outcome {
    measured,
    refused,    // by the solver, the path or the driver: AccuracyPoint::why
    notFinite,  // it blew up
    leftOut,    // for want of time
};
const char* name(Outcome outcome);  // "measured", "refused", "not finite", "left out"

// One method at one step.
struct AccuracyPoint {
    Method method;
    Step step;
    double stepsPerSecond = 0;  // of simulated time
    Outcome outcome = Outcome::leftOut;
    std::string why;                  // of a refusal, or what was left out
    std::optional<ErrorParts> error;  // nothing in a scene that is chaotic or too stiff for a reference
    std::optional<Drift> drift;
    Spread time;            // s per vertex and simulated second; no samples: not timed
    size_t stateBytes = 0;  // on the device, of all timed molecules
    bool front = false;     // no other point is both faster and nearer
};

struct AccuracyOptions {
    double duration = 1;                        // s of simulated time, rounded to whole frames
    int molecules = 8;                          // of each group, whose error is measured
    int timedMolecules = 16384;                 // of each group, at most
    std::vector<SolverKind> solvers = {};       // empty: all
    std::vector<FieldSampling> samplings = {};  // empty: all that differ in this scene
    std::optional<double> seconds = {};         // of all of it, about; nothing: as long as it takes. At least
                                                // the cheapest step of a method is measured and timed
    // Frames are made shorter than the scene's, down to this share, while a method's smallest error is above
    // `enough` at the most substeps that a frame may have.
    int mostSplits = 16;
    double enough = 1e-3;
    // Asked for after the estimate: points beside the ladder, such as what a calibration chooses, in at most
    // so many seconds.
    std::function<std::vector<std::pair<Method, Step>>(std::optional<double> seconds)> extra = {};
};

// A group as it was measured.
struct AccuracyGroup {
    std::string name, molecule;
    int vertices = 0, springs = 0;
    int measured = 0, timed = 0;  // molecules
    double size = 0;              // m
    double highestFrequency = 0;  // rad/s
};

struct AccuracyReport {
    std::string scene;
    double frameRate = 60;  // Hz
    double duration = 1;    // s, as rounded
    Path path = Path::fused;
    std::vector<AccuracyGroup> groups;
    std::vector<AccuracyPoint> points;  // curve by curve, by growing steps per second
    std::string chaotic, tooStiff;      // why there are no errors; both empty: there are
    double referenceError = 0;          // relative, a bound
    std::vector<std::string> notes;     // for people
    double seconds = 0;                 // that the measurement took

    bool hasErrors() const { return chaotic.empty() && tooStiff.empty(); }
};

struct AccuracyProgress {
    // Once, before the long part: of all that follows.
    std::function<void(double seconds)> estimate = [](double) {};
    // Once, when `extra` and the reference are done: of what follows, and the share of all errors and times
    // that this has room for.
    std::function<void(double seconds, double share)> left = [](double, double) {};
    std::function<void(const char* words)> stage = [](const char*) {};  // "reference", ...
    std::function<void(double share)> tell = [](double) {};             // of the whole that is done
};

// Error: the scene has no groups; nothing of what is asked for can run it.
AccuracyReport measureAccuracy(const Scene& scene, const AccuracyOptions& options,
                               const AccuracyDevice& device, const AccuracyProgress& progress = {});

// Steps by growing number: 1, 2, 4, … substeps and, beyond maxSubsteps, shorter frames.
std::vector<Step> stepLadder(int mostSplits);

// ---- Points, pure: which are worth having

// Indices of the points of which no other is both at least as fast and at least as near (of equals the first
// stays), by growing time.
std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& timeAndError);

// Sets AccuracyPoint::front of all that have a time and an error.
void markFront(std::vector<AccuracyPoint>& points);

}  // namespace shoal::measure
