// Where the molecules of a sample ought to end, so that an error can be claimed of hundreds of molecules, of
// which a few may do what no other does: by the double-precision reference, each by itself. Where that takes
// too long, by a method on the device whose step is halved until their ends stay where they are.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "measure/accuracy_reference.h"
#include "measure/method_runner.h"
#include "measure/timing.h"

namespace shoal::measure {

// The errors of a method over the sample. An error is relative: accuracy_reference.h.
struct SampleError {
    double rms = 0, worst = 0;  // of the molecules whose error is known
    int molecules = 0;          // all of the sample
    int above = 0;              // of them, above the error wanted
    // Neither known to be below it nor above: chaotic, finer than floats tell, too stiff, or no time was
    // left for their reference.
    int unknown = 0;

    // Known to be below the error for 99 of 100 molecules, and in the RMS; ten times that for none.
    bool holds(double error) const;
};

class MoleculeSample {
  public:
    static constexpr double referenceSeconds = 3;  // a molecule, at most

    // All molecules of the runner's scene, from their start; the runner is left there. `error`: what is
    // wanted; `frames`: of the scene, after which it is. The first `few` molecules of each group have their
    // reference before the others. What is not settled within the limit stays so. Borrows scene and device.
    MoleculeSample(const Scene& scene, MethodRunner& runner, double error, int frames, int few,
                   const AccuracyDevice& device, TimeLimit limit);

    void settle();
    // All but one of a hundred.
    bool settled() const { return 100 * unsettled() <= molecules(); }
    bool outOfTime() const { return limit_.over() || exact_.cutShort(); }
    int unsettled() const;
    int molecules() const { return int(molecules_.size()); }
    // Why a molecule had no reference; empty: each that had its time has one.
    const std::string& why() const { return exact_.why(); }
    // Whether one of the first molecules has a reference: without, nothing on the device can be judged.
    bool hasReference() const;
    // "300 by the reference"; "40 by the reference, 260 by leapfrog with 128 substeps"
    std::string how() const;

    SampleError errorOf(const std::vector<Snapshot>& ends) const;
    // RMS over those of the first molecules that have a reference; ends of these at least.
    double errorOfFew(const std::vector<Snapshot>& ends) const;

  private:
    static constexpr double unknownChange = 1e30;
    // Index: as in exact_.
    struct SampledMolecule {
        double change = unknownChange;  // of its end when the step was halved
        bool exact = false;             // the reference has it
    };
    void solve(int most, const TimeLimit& limit);  // those that are open among the first ones of each group
    bool settleBy(SolverKind kind);
    std::vector<double> distances(const std::vector<Snapshot>& a, const std::vector<Snapshot>& b) const;
    double error(size_t molecule, const std::vector<Snapshot>& ends) const;
    bool settled(const SampledMolecule& molecule) const;

    const Scene& scene_;
    double error_;
    int frames_, few_;
    const AccuracyDevice& device_;
    TimeLimit limit_;
    ExactEnds exact_;
    std::vector<SampledMolecule> molecules_;
    std::vector<Snapshot> ends_;  // of the method that settled those without a reference
    std::string by_;              // that method
};

}  // namespace shoal::measure
