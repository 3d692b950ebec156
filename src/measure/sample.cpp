#include "measure/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shoal::measure {

namespace {

constexpr double nearEnough = 0.3;   // of the error wanted: a change when the step is halved
constexpr double exactEnough = 0.1;  // likewise, by the reference, where there is time
constexpr double patience = 1.5;     // s, of all references, before the device is asked
constexpr double secondsARun = 6;    // of all molecules by one method at one step
constexpr double stalled = 0.9;      // of the molecules that a step leaves unsettled: its half leaves as many
constexpr int mostWorst = 10;        // times the error wanted

// Another method where one does not settle the molecules: one of higher order has less noise in float,
// because it takes fewer steps, and what is stiff stays to the implicit ones.
std::vector<SolverKind> settlers() {
    std::vector<SolverKind> out{SolverKind::leapfrog};
    for (const Solver& candidate : solvers())
        if (candidate.rungeKutta() && candidate.order > solver(SolverKind::leapfrog).order)
            out.push_back(candidate.kind);
    out.insert(out.end(), {SolverKind::bdf2Corotated, SolverKind::bdf2Xpbd});
    return out;
}

std::vector<Snapshot> startsOf(MethodRunner& runner) {
    runner.restart();
    return runner.snapshots();
}

}  // namespace

bool SampleError::holds(double error) const {
    return molecules > unknown && rms < error && 100 * (above + unknown) <= molecules &&
           worst < mostWorst * error;
}

MoleculeSample::MoleculeSample(const Scene& scene, MethodRunner& runner, double error, int frames, int few,
                               const AccuracyDevice& device, TimeLimit limit)
    : scene_(scene),
      error_(error),
      frames_(frames),
      few_(few),
      device_(device),
      limit_(std::move(limit)),
      exact_(scene, runner.simulation().plan(), startsOf(runner), frames / scene.frameRate, device.cores,
             std::numeric_limits<int>::max()),
      molecules_(size_t(exact_.molecules())) {}

bool MoleculeSample::settled(const SampledMolecule& molecule) const {
    return molecule.change <= nearEnough * error_;
}

int MoleculeSample::unsettled() const {
    return int(std::count_if(molecules_.begin(), molecules_.end(),
                             [&](const SampledMolecule& molecule) { return !settled(molecule); }));
}

bool MoleculeSample::hasReference() const {
    for (size_t i = 0; i < molecules_.size(); ++i)
        if (molecules_[i].exact && exact_.number(i) < few_) return true;
    return false;
}

void MoleculeSample::settle() {
    solve(few_, limit_);
    if (!hasReference()) return;
    const int all = std::numeric_limits<int>::max();
    solve(all, TimeLimit(std::min(patience, limit_.left())));
    if (settled()) return;
    for (const SolverKind kind : settlers())
        if (settleBy(kind) || limit_.over()) return;
    solve(all, limit_);
}

void MoleculeSample::solve(int most, const TimeLimit& limit) {
    std::vector<size_t> open;
    for (size_t i = 0; i < molecules_.size(); ++i)
        if (!settled(molecules_[i]) && !exact_.chaotic(i) && exact_.number(i) < most) open.push_back(i);
    exact_.solveEach(open, exactEnough * error_, referenceSeconds, limit);
    for (const size_t i : open) {
        if (exact_.bound(i) > nearEnough * error_) continue;
        molecules_[i] = {.change = exact_.bound(i), .exact = true};
    }
}

double MoleculeSample::error(size_t molecule, const std::vector<Snapshot>& ends) const {
    return exact_.errorOf(molecule, ends[exact_.group(molecule)]);
}

std::vector<double> MoleculeSample::distances(const std::vector<Snapshot>& a,
                                              const std::vector<Snapshot>& b) const {
    std::vector<double> out;
    for (size_t i = 0; i < molecules_.size(); ++i) {
        const size_t g = exact_.group(i);
        out.push_back(reference::relativeError(ExactEnds::stateOf(a[g], exact_.number(i)),
                                               ExactEnds::stateOf(b[g], exact_.number(i)), exact_.size(i)));
    }
    return out;
}

// Returns whether it did. Ends that an earlier method has settled better stay.
bool MoleculeSample::settleBy(SolverKind kind) {
    MethodRunner method(scene_, Method{kind, {}}, device_);
    int substeps = 16;
    while (substeps < maxSubsteps && !method.refusal({substeps, 1}).empty())
        substeps *= 2;
    std::vector<Snapshot> coarse;
    int before = molecules();
    for (; substeps <= maxSubsteps; substeps *= 2) {
        const Clock::time_point start = Clock::now();
        try {
            method.set({substeps, 1});
        } catch (const Error&) {
            return false;  // the path or the driver refuses the method
        }
        method.run(frames_);
        const std::vector<Snapshot> fine = method.snapshots();
        const double seconds = secondsSince(start);
        if (!coarse.empty() && errorOfFew(fine) <= error_) {
            const std::vector<double> change = distances(coarse, fine);
            int open = 0;
            for (size_t i = 0; i < molecules_.size(); ++i)
                open += !molecules_[i].exact && !(change[i] <= nearEnough * error_);
            if (open < unsettled()) {
                for (size_t i = 0; i < molecules_.size(); ++i)
                    if (!molecules_[i].exact)
                        molecules_[i].change = std::isfinite(change[i]) ? change[i] : unknownChange;
                ends_ = fine;
                by_ = concat(shoal::name(kind), " with ", substeps, " substeps");
            }
            if (settled()) return true;
            if (2 * before < molecules() && open > stalled * before) break;
            before = open;
        }
        if (2 * seconds > std::min(secondsARun, limit_.left())) break;
        coarse = fine;
    }
    return settled();
}

std::string MoleculeSample::how() const {
    int exact = 0, others = 0;
    for (const SampledMolecule& molecule : molecules_) {
        exact += molecule.exact;
        others += !molecule.exact && settled(molecule);
    }
    if (others == 0) return concat(exact, " by the reference");
    return concat(exact, " by the reference, ", others, " by ", by_);
}

double MoleculeSample::errorOfFew(const std::vector<Snapshot>& ends) const {
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i < molecules_.size(); ++i) {
        if (!molecules_[i].exact || exact_.number(i) >= few_) continue;
        sum += std::pow(error(i, ends), 2);
        ++count;
    }
    return std::sqrt(sum / count);
}

SampleError MoleculeSample::errorOf(const std::vector<Snapshot>& ends) const {
    const std::vector<double> apart = ends_.empty() ? std::vector<double>() : distances(ends, ends_);
    SampleError out;
    out.molecules = molecules();
    for (size_t i = 0; i < molecules_.size(); ++i) {
        const SampledMolecule& molecule = molecules_[i];
        if (!(molecule.change < unknownChange)) {
            ++out.unknown;
            continue;
        }
        double found = molecule.exact ? error(i, ends) : apart[i];
        if (!settled(molecule)) {
            // what it is at least says enough where that is above, and at most where that is below
            const double least = found - molecule.change, most = found + molecule.change;
            if (!(least > error_ || most < error_)) {
                ++out.unknown;
                continue;
            }
            found = least > error_ ? least : most;
        }
        out.worst = std::max(out.worst, found);
        out.rms += found * found;
        out.above += found > error_;
    }
    out.rms = std::sqrt(out.rms / std::max(1, out.molecules - out.unknown));
    return out;
}

}  // namespace shoal::measure
