// Where the molecules of a sample ought to end: the first ones by the double-precision reference, the others
// by a method on the device whose step has been halved until their ends stay where they are. So an error can
// be claimed of hundreds of molecules, of which a few may do what no other does.
#pragma once

#include <map>
#include <memory>

#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"

namespace shoal::measure {

// Molecules of each group: if one of a hundred fails, so many show it with a probability of 95 %.
constexpr int sampleMolecules = 300;

// The errors of a method over the sample. An error is relative: accuracy_reference.h.
struct SampleError {
    double rms = 0, worst = 0;
    int measured = 0;  // molecules, to a third of the error wanted or nearer: those of the RMS
    int compared = 0;  // those, and what could be told to three times that error
    int untold = 0;    // the others: chaotic, too stiff, or no time was left for their reference
    int above = 0;     // of those measured: above the error wanted

    // Below the error for 99 of 100 molecules and in the RMS; ten times that for none.
    bool holds(double error) const;
};

class MoleculeSample {
  public:
    // `error`: what is wanted; `core`: of the first molecules of the scene's groups. Borrows all of them.
    MoleculeSample(const Scene& scene, double error, int frames, const ExactEnds& core,
                   const AccuracyDevice& device);

    // Finds the method that the others are held against. What it does not settle has the reference, as far as
    // time allows.
    void settle();
    // "4 by the reference, 296 by leapfrog with 128 substeps"
    std::string how() const;

    // A molecule that comes out far off is held against the reference, where these are few.
    SampleError errorOf(const std::vector<Snapshot>& ends);

  private:
    struct One {
        size_t group = 0;
        int index = 0;                   // in the group
        double size = 1;                 // m
        double change = 1e30;            // of its end when the step was halved; 0: the reference has it
        std::unique_ptr<ExactEnds> own;  // its reference
        std::optional<size_t> inCore;    // its place there
        bool given = false;              // asked for a reference, which it has or cannot have
    };
    bool settleBy(SolverKind kind);
    std::vector<double> distances(const std::vector<Snapshot>& a, const std::vector<Snapshot>& b) const;
    void ask(One& one);
    bool told(const One& one) const;
    bool settled() const;

    const Scene& scene_;
    double error_;
    int frames_;
    const ExactEnds& core_;
    const AccuracyDevice& device_;
    std::unique_ptr<MethodRunner> runner_;  // whose plan and starts the references are of
    std::vector<Snapshot> starts_, ends_;   // ends_: of the method that settled them
    std::string by_;
    std::vector<One> molecules_;
    int asked_ = 0;
};

}  // namespace shoal::measure
