// Finds, by measuring, the cheapest method, step and field sampling whose error on a scene is below a given
// one. The error is that of a few molecules against the reference. Candidates are tried in the order of what
// their substeps cost. Each is bisected to the fewest substeps that suffice, and given up when it can no
// longer beat the best. Those that get there are timed again, in turn. The result must hold over a sample of
// some hundred molecules, or it takes more substeps: the claimed error is that of the sample.
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
#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"
#include "measure/timing.h"

namespace shoal::measure {

// Molecules of each group: if one of a hundred fails, so many show it with a probability of 95 %.
constexpr int sampleMolecules = 300;

// The errors of a method over the sample. An error is relative: accuracy_reference.h.
struct SampleError {
    double rms = 0, worst = 0;  // of the molecules whose error is known
    int molecules = 0;          // all of the sample
    int above = 0;              // of them, above the error wanted
    // Of them, not known to be below or above it: chaotic, finer than floats tell, too stiff, or no time was
    // left for their reference.
    int unknown = 0;

    // Known to be below the error for 99 of 100 molecules, and in the RMS; ten times that for none.
    bool holds(double error) const;
};

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
    bool kept = false;   // was found before
    double seconds = 0;  // that the search took
};

// Error: no method gets there, or none in time: which is best, with which step, how near; or there is no
// reference; or the error is below what single floats hold, which is told before anything is measured.
Calibration calibrate(const Scene& scene, const CalibrationOptions& options, const AccuracyDevice& device);

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

// Where the molecules of a sample ought to end: the first ones by the double-precision reference, the others
// by a method on the device whose step has been halved until their ends stay where they are. So an error can
// be claimed of hundreds of molecules, of which a few may do what no other does.
class MoleculeSample {
  public:
    static constexpr double referenceSeconds = 3;  // a molecule

    // `error`: what is wanted; `core`: of the first molecules of the scene's groups. Borrows all of them.
    // `limit`: what is not settled by then stays so.
    MoleculeSample(const Scene& scene, double error, int frames, const ExactEnds& core,
                   const AccuracyDevice& device, TimeLimit limit);

    // Finds the method that the others are held against. What it does not settle has the reference, as far as
    // time allows.
    void settle();
    // All but one of a hundred.
    bool settled() const { return !molecules_.empty() && 100 * unsettled() <= molecules(); }
    bool outOfTime() const { return outOfTime_; }  // rather than out of ways
    int unsettled() const;
    int molecules() const { return int(molecules_.size()); }
    // "4 by the reference, 296 by leapfrog with 128 substeps"
    std::string how() const;

    // A molecule that comes out far off is held against the reference, where these are few.
    SampleError errorOf(const std::vector<Snapshot>& ends);

  private:
    static constexpr double unknownChange = 1e30;
    struct SampledMolecule {
        size_t group = 0;
        int index = 0;                     // in the group
        double size = 1;                   // m
        double change = unknownChange;     // of its end when the step was halved; 0: the reference has it
        const ExactEnds* exact = nullptr;  // the reference that has it,
        size_t place = 0;                  // and where among its molecules
        bool asked = false;                // for a reference of its own, which it has or cannot have
        bool given() const { return exact != nullptr || asked; }
    };
    bool settleBy(SolverKind kind);
    std::vector<double> distances(const std::vector<Snapshot>& a, const std::vector<Snapshot>& b) const;
    void ask(SampledMolecule& molecule);
    bool settled(const SampledMolecule& molecule) const;

    const Scene& scene_;
    double error_;
    int frames_;
    const ExactEnds& core_;
    const AccuracyDevice& device_;
    TimeLimit limit_;
    std::unique_ptr<MethodRunner> runner_;  // whose plan and starts the references are of
    std::vector<Snapshot> starts_, ends_;   // ends_: of the method that settled them
    std::string by_;
    std::vector<SampledMolecule> molecules_;
    std::vector<std::unique_ptr<ExactEnds>> own_;  // references of single molecules
    int asked_ = 0;
    bool outOfTime_ = false;
};

}  // namespace shoal::measure
