// The cheapest method, step and field sampling whose error on a scene is below a given one, found by
// measuring: a few molecules against the reference, candidates in the order of what their substeps cost,
// each bisected to the fewest substeps that do, and given up where it cannot beat the best any more, timed
// again in turn. What gets there has to hold over a sample of some hundred molecules (sample.h), else it
// takes more substeps: what is claimed is claimed of that sample.
//
// The result is kept as a file under a hash of everything that it depends on: the scene as compiled (with its
// molecules), the error, what the search was narrowed to, the shaders, the kernels, the driver, the
// processor, the version.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/method_runner.h"
#include "measure/sample.h"

namespace shoal::measure {

struct CalibrationOptions {
    double error = 1e-3;  // relative: see accuracy_reference.h
    // These narrow the search; empty: everything.
    std::vector<SolverKind> solvers = {};
    std::vector<FieldSampling> samplings = {};
    std::optional<int> substeps = {};
    double duration = 1;      // s of simulated time; less where there is no reference then, to an eighth
    int molecules = 4;        // of each group, with the reference
    std::string version;      // of the program
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

// Error: no method gets there: which is best, with which step, how near; or there is no reference.
Calibration calibrate(const Scene& scene, const CalibrationOptions& options, const AccuracyDevice& device);

// The scene with what was found.
void apply(const Calibration& calibration, Scene& scene);

}  // namespace shoal::measure
