#include "measure/calibrate.h"

#include <algorithm>
#include <cmath>

namespace shoal::measure {

namespace {

constexpr double nearEnough = 0.3;  // of the error wanted: a change when the step is halved
constexpr double secondsARun = 6;   // of all molecules by one method at one step
constexpr double stalled = 0.9;     // of the molecules that a step leaves unsettled: its half leaves as many
constexpr int mostAsked = 6;
constexpr int mostWorst = 10;  // times the error wanted

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

}  // namespace

bool SampleError::holds(double error) const {
    return molecules > unknown && rms < error && 100 * (above + unknown) <= molecules &&
           worst < mostWorst * error;
}

MoleculeSample::MoleculeSample(const Scene& scene, double error, int frames, const ExactEnds& core,
                               const AccuracyDevice& device, TimeLimit limit)
    : scene_(scene), error_(error), frames_(frames), core_(core), device_(device), limit_(std::move(limit)) {}

std::vector<double> MoleculeSample::distances(const std::vector<Snapshot>& a,
                                              const std::vector<Snapshot>& b) const {
    std::vector<double> out;
    for (const SampledMolecule& molecule : molecules_)
        out.push_back(reference::relativeError(ExactEnds::stateOf(a[molecule.group], molecule.index),
                                               ExactEnds::stateOf(b[molecule.group], molecule.index),
                                               molecule.size));
    return out;
}

bool MoleculeSample::settled(const SampledMolecule& molecule) const {
    return molecule.change <= nearEnough * error_;
}

int MoleculeSample::unsettled() const {
    return int(std::count_if(molecules_.begin(), molecules_.end(),
                             [&](const SampledMolecule& molecule) { return !settled(molecule); }));
}

void MoleculeSample::settle() {
    for (const SolverKind kind : settlers())
        if (settleBy(kind) || limit_.over()) break;
    outOfTime_ = outOfTime_ || limit_.over();
    if (100 * (unsettled() - mostAsked) > molecules()) return;  // too many for references of their own
    for (SampledMolecule& molecule : molecules_)
        if (!settled(molecule)) ask(molecule);
}

// Whether it did. What an earlier method settled better stays.
bool MoleculeSample::settleBy(SolverKind kind) {
    auto runner = std::make_unique<MethodRunner>(scene_, Method{kind, {}}, device_);
    int substeps = 16;
    while (substeps < maxSubsteps && !runner->refusal({substeps, 1}).empty())
        substeps *= 2;
    try {
        if (2 * substeps <= maxSubsteps) runner->set({substeps, 1});
    } catch (const Error&) {
        return false;  // the path or the driver refuses the method
    }
    if (2 * substeps > maxSubsteps) return false;
    runner->restart();
    MethodRunner& method = *runner;
    if (!runner_) {
        starts_ = runner->snapshots();
        const Plan& plan = runner->simulation().plan();
        for (size_t g = 0; g < starts_.size(); ++g) {
            for (int m = 0; m < starts_[g].count; ++m) {
                SampledMolecule& molecule = molecules_.emplace_back();
                molecule.group = g;
                molecule.index = m;
                const double size = scene_.groups[plan.groups[g].index].molecule.size() *
                                    double(plan.groups[g].constants.scales[size_t(m)]);
                molecule.size = size > 0 ? size : 1;
                if (const std::optional<size_t> place = core_.placeOf(g, m)) {
                    molecule.exact = &core_;
                    molecule.place = *place;
                    molecule.change = 0;
                }
            }
        }
        runner_ = std::move(runner);
        if (settled()) return true;
    }
    std::vector<Snapshot> coarse;
    int before = int(molecules_.size());
    for (; substeps <= maxSubsteps; substeps *= 2) {
        const Clock::time_point start = Clock::now();
        method.set({substeps, 1});
        method.run(frames_);
        const std::vector<Snapshot> fine = method.snapshots();
        const double seconds = secondsSince(start);
        if (!coarse.empty() && core_.errorOf(fine).worst <= error_) {
            const std::vector<double> change = distances(coarse, fine);
            int open = 0;
            for (size_t i = 0; i < molecules_.size(); ++i)
                open += !molecules_[i].given() && !(change[i] <= nearEnough * error_);
            if (open < unsettled()) {
                for (size_t i = 0; i < molecules_.size(); ++i)
                    if (!molecules_[i].given())
                        molecules_[i].change = std::isfinite(change[i]) ? change[i] : unknownChange;
                ends_ = fine;
                by_ = concat(shoal::name(kind), " with ", substeps, " substeps");
            }
            if (settled()) return true;
            if (2 * before < molecules() && open > stalled * before) break;
            before = open;
        }
        outOfTime_ = outOfTime_ || 2 * seconds > limit_.left();
        if (2 * seconds > std::min(secondsARun, limit_.left())) break;
        coarse = fine;
    }
    return settled();
}

void MoleculeSample::ask(SampledMolecule& molecule) {
    if (molecule.given() || asked_ >= mostAsked || limit_.over()) return;
    molecule.asked = true;
    ++asked_;
    const std::vector<std::pair<size_t, int>> which = {{molecule.group, molecule.index}};
    auto own = std::make_unique<ExactEnds>(scene_, runner_->simulation().plan(), starts_,
                                           frames_ / scene_.frameRate, device_.cores, which);
    const Settled found = own->solve(0.01 * error_, std::min(referenceSeconds, limit_.left()));
    if (found != Settled::yes && !(found == Settled::roughly && own->error() <= nearEnough * error_))
        return;  // what the device says of it stays
    molecule.change = 0;
    molecule.exact = own_.emplace_back(std::move(own)).get();
}

std::string MoleculeSample::how() const {
    int exact = 0, others = 0;
    for (const SampledMolecule& molecule : molecules_) {
        exact += molecule.exact != nullptr;
        others += molecule.exact == nullptr && settled(molecule);
    }
    if (others == 0) return concat(exact, " by the reference");
    return concat(exact, " by the reference, ", others, " by ", by_);
}

SampleError MoleculeSample::errorOf(const std::vector<Snapshot>& ends) {
    const std::vector<double> inCore = core_.eachOf(ends);
    const std::vector<double> apart = ends_.empty() ? std::vector<double>() : distances(ends, ends_);
    const auto errorOf = [&](size_t i) {
        const SampledMolecule& molecule = molecules_[i];
        return molecule.exact == &core_    ? inCore[molecule.place]
               : molecule.exact != nullptr ? molecule.exact->errorOf(ends).worst
                                           : apart[i];
    };
    std::vector<size_t> far;
    for (size_t i = 0; i < molecules_.size(); ++i)
        if (!molecules_[i].given() && settled(molecules_[i]) && errorOf(i) > mostWorst * error_)
            far.push_back(i);
    if (int(far.size()) + asked_ <= mostAsked)
        for (const size_t i : far)
            ask(molecules_[i]);
    SampleError out;
    out.molecules = molecules();
    for (size_t i = 0; i < molecules_.size(); ++i) {
        const SampledMolecule& molecule = molecules_[i];
        if (!molecule.exact && !(molecule.change < unknownChange)) {
            ++out.unknown;
            continue;
        }
        double error = errorOf(i);
        if (!settled(molecule)) {
            // what it is at least says enough where that is above, and at most where that is below
            const double least = error - molecule.change, most = error + molecule.change;
            if (!(least > error_ || most < error_)) {
                ++out.unknown;
                continue;
            }
            error = least > error_ ? least : most;
        }
        out.worst = std::max(out.worst, error);
        out.rms += error * error;
        out.above += error > error_;
    }
    out.rms = std::sqrt(out.rms / std::max(1, out.molecules - out.unknown));
    return out;
}

}  // namespace shoal::measure
