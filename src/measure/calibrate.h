// Finds, by measuring, the cheapest method, step and field sampling whose error on a scene is below a given
// one. The error is that of a few molecules against the reference. Candidates are tried in the order of what
// their substeps cost. Each is bisected to the fewest substeps that suffice, and given up when it can no
// longer beat the best. Those that get there are timed again, in turn. The result must hold over a sample of
// some hundred molecules, or it takes more substeps: the claimed error is that of the sample.
//
// Where molecules touch, paths part, and what can be wanted of them is that they do not overlap: there it
// chooses the substeps and iterations of contact, the cheapest of its curve (measure/contact_curve.h) at
// which spheres overlap by less than the error of their radius, RMS. The solver stays what the scene runs
// with.
//
// The result is kept as a file, <folder>/calibrations/<key>.json, under a hash of everything that it depends
// on: the scene as compiled (with its molecules), the error, what the search was narrowed to, the shaders,
// the kernels, the driver, the processor, the version. A search that ran out of time is not kept.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "core/json.h"
#include "measure/contact_curve.h"
#include "measure/method_runner.h"
#include "measure/sample.h"

namespace shoal::measure {

// Molecules of each group: if one of a hundred fails, so many show it with a probability of 95 %.
constexpr int sampleMolecules = 300;

struct CalibrationOptions {
    double error = 1e-3;  // relative: see accuracy_reference.h
    // These narrow the search; empty: everything.
    std::vector<SolverKind> solvers = {};
    std::vector<FieldSampling> samplings = {};
    std::optional<int> substeps = {};
    double duration = 1;  // s of simulated time; less where ends are not known then, to an eighth
    int molecules = 4;    // of each group, with the reference
    std::optional<double> seconds = 60;  // of the search, about: then the best that was found is taken
    std::string limitOption = "--error-seconds";        // where users give more of them
    std::function<void(const std::string&)> tell = {};  // what is done next, when that changes
    std::string version;                                // of the program
    std::string processor;    // its name: renderers that draw in software go by one name on all
    std::string folder = {};  // where results are kept; empty: nowhere
};

// How far one method got.
struct Candidate {
    Method method;
    int substeps = 0;             // of a frame; 0: none was run
    std::optional<double> error;  // RMS at these, of the sample or, where it never got so far, of a few
    std::optional<double> worst;  // of the sample
    double cost = 0;              // s per vertex and simulated second, at these; 0: not known
    bool reached = false;         // the error wanted holds
    std::string why;              // what became of it
};

struct Calibration {
    double target = 0;
    Method method;
    int substeps = 0;
    double error = 0;  // measured: RMS of the sample
    SampleError sample;
    std::string how;      // what the sample was held against
    double cost = 0;      // s per vertex and simulated second
    double duration = 0;  // s, after which the error was taken
    std::string why;
    std::vector<Candidate> candidates;
    std::optional<ContactPoint> contact;  // where molecules touch: in place of method, sample and cost
    bool kept = false;                    // was found before
    double seconds = 0;                   // that the search took
};

// Error: no method gets there, or none in time: which is best, with which step, how near; or there is no
// reference; or the error is below what single floats hold, which is told before anything is measured.
Calibration calibrate(const Scene& scene, const CalibrationOptions& options, const AccuracyDevice& device);

// Chooses for contact between molecules. `whole`: no point of the curve was left out for want of time.
// Error: as calibrate().
Calibration calibrateContact(const Scene& scene, const CalibrationOptions& options,
                             const AccuracyDevice& device, bool& whole);

// The scene with what was found.
void apply(const Calibration& calibration, Scene& scene);

// The files of results.

// 32 hexadecimal digits of everything that a calibration depends on. `plan`: of the scene, with a solver that
// takes every step.
std::string calibrationKey(const Plan& plan, const CalibrationOptions& options, const AccuracyDevice& device);

// Nothing where there is none, or none that can be read: it is measured anew.
std::optional<Calibration> loadCalibration(const std::string& folder, const std::string& key);
// Does nothing without a folder. A disk that is full, or a folder that cannot be made, is no mistake of the
// user's: the next run measures again.
void keepCalibration(const std::string& folder, const std::string& key, const Calibration& calibration);

JsonValue asJson(const Calibration& calibration);

}  // namespace shoal::measure
