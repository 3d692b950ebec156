#include "measure/calibrate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/accuracy.h"
#include "measure/timing.h"

namespace shoal::measure {

namespace {

// A sampling other than the exact one is tried for solvers within this factor of the best: reading fields
// less often does not save more.
constexpr double worthSampling = 10;
constexpr int mostTries = 8;          // of more substeps for the sample
constexpr double closeEnough = 1.12;  // of the fewest substeps that do
constexpr double readying = 0.5;      // of the time: to make methods ready, before they are tried
constexpr int fewOnGpu = 4096, fewOnCpu = 32;
// Enough to fill the device, few enough to be quick.
constexpr int manyOnGpu = 16384, manyOnCpu = 2048;

class Search {
  public:
    Search(const Scene& scene, const CalibrationOptions& options, const AccuracyDevice& device)
        : options_(options), device_(device), place_{scene.file, 0, 0, {}} {
        const bool software = device.context->info().software;
        // what a lane does costs a GPU nothing more in its neighbours
        few_ = withMolecules(scene, software ? std::max(fewOnCpu, options.molecules) : fewOnGpu);
        many_ = withMolecules(scene, software ? manyOnCpu : manyOnGpu);
        all_ = withMolecules(scene, sampleMolecules);
        frames_ = std::max(1, int(std::lround(options.duration * scene.frameRate)));
        ladder_ = stepLadder(1);
        ladder_.push_back({maxSubsteps, 1});
        if (options.substeps) ladder_ = {{*options.substeps, 1}};
    }

    Calibration run() {
        std::vector<Method> others;  // that read fields less often than the first sampling does
        const std::vector<Method> methods = methodsInTurn(few_, options_.solvers, options_.samplings);
        for (const Method& method : methods) {
            if (method.sampling != methods.front().sampling)
                others.push_back(method);
            else if (runs_.empty() || !late(readying))
                probe(method);
        }
        searchAll();
        const Run* best = cheapest();
        const double mostCost = best == nullptr ? 0 : worthSampling * best->candidate.cost;
        for (const Method& method : others) {
            const bool worth = std::any_of(runs_.begin(), runs_.end(), [&](const Run& run) {
                return run.method.solver == method.solver && run.candidate.reached &&
                       run.candidate.cost <= mostCost;
            });
            if (worth && !late()) probe(method);
        }
        searchAll();
        timeAgain();
        return conclude();
    }
    // Whether more than this share of the time is over.
    bool late(double share = 1) const { return limit_.over(share); }
    bool hurried() const { return hurried_; }

  private:
    void tell(const std::string& what) const {
        if (options_.tell) options_.tell(what);
    }

    struct Run : MethodOnBoth {
        Candidate candidate;
        std::unique_ptr<MethodRunner> all;  // of the sample
        SampleError sample;
        bool searched = false;
    };

    void probe(const Method& method) {
        tell(concat("making ", name(method.solver), " ready"));
        Run& run = runs_.emplace_back(Run{makeReady(method, few_, many_, ladder_, device_), {}, {}, {}, {}});
        run.candidate.method = method;
        run.searched = !run.refused.empty();
        if (run.searched)
            run.candidate.why = concat("refused: ", run.refused);
        else if (!sample_)
            solveSample(run);
    }

    // Where the ends of more than one of a hundred molecules are not known over the whole time, over a
    // shorter one.
    void solveSample(Run& run) {
        run.all = std::make_unique<MethodRunner>(all_, run.method, device_);
        run.all->set(run.few->step());
        for (const int least = std::max(1, frames_ / 8);; frames_ = std::max(least, frames_ / 2)) {
            tell(concat("solving a sample of up to ", sampleMolecules, " molecules a group over ",
                        frames_ / few_.frameRate, " s"));
            const bool last = frames_ == least || late(readying);
            // in half of the time that is left, so that a shorter motion has some
            const double share = last || !options_.seconds
                                     ? readying
                                     : 1 - (limit_.left() - 0.5 * limit_.left(readying)) / *options_.seconds;
            sample_ = std::make_unique<MoleculeSample>(all_, *run.all, options_.error, frames_,
                                                       options_.molecules, device_, limit_.part(share));
            sample_->settle();
            if (sample_->settled()) return;
            hurried_ = hurried_ || sample_->outOfTime();
            if (last) refuseUnsettled();
        }
    }

    [[noreturn]] void refuseUnsettled() const {
        if (hurried_) refuseForTime(nullptr);
        if (!sample_->hasReference())
            throw Error(place_, concat("--error: no error can be given: ", sample_->why()));
        throw Error(place_, concat("--error ", options_.error, " cannot be claimed: the ends of ",
                                   sample_->unsettled(), " of ", sample_->molecules(),
                                   " molecules still change when the step is halved, after ",
                                   frames_ / few_.frameRate,
                                   " s of motion that is chaotic, or finer than single floats tell"));
    }

    // Cheapest substeps first, so that the dear ones have a good bound to beat.
    void searchAll() {
        // of second order and more first: they get there soonest
        const auto turn = [](const Run* run) {
            return std::pair(solver(run->method.solver).order <= 1, run->manyCost.each);
        };
        std::vector<Run*> order;
        for (Run& run : runs_)
            if (!run.searched) order.push_back(&run);
        std::stable_sort(order.begin(), order.end(),
                         [&](const Run* a, const Run* b) { return turn(a) < turn(b); });
        for (Run* run : order)
            search(*run);
    }

    void search(Run& run) {
        run.searched = true;
        tell(concat("trying ", name(run.method.solver)));
        int failed = 0, good = 0;
        SmallestError smallest;
        for (const Step& step : ladder_) {
            const int substeps = step.substeps;
            if (!run.few->refusal(step).empty()) {
                failed = substeps;
                continue;
            }
            if (late()) {
                run.candidate.why = "no time was left";
                return;
            }
            if (!canWin(run, substeps)) return;
            const double error = measure(run, substeps);
            if (error < options_.error) {
                good = substeps;
                break;
            }
            failed = substeps;
            if (smallest.isPassedBy(error)) break;
        }
        if (good == 0) {
            run.candidate.why = std::isfinite(smallest.error)
                                    ? concat("does not get there: at best ", *run.candidate.error)
                                    : "blows up at every step";
            return;
        }
        refine(run, failed, good);
        if (!holds(run)) return;
        run.candidate.reached = true;
        run.candidate.cost = costAt(run, run.candidate.substeps);
        run.candidate.why = "gets there";
    }

    // Takes more substeps until what the few molecules have shown holds over the sample.
    bool holds(Run& run) {
        Candidate& candidate = run.candidate;
        for (int tries = 0;; ++tries) {
            run.sample = errorOfSample(run, candidate.substeps);
            candidate.error = run.sample.rms;
            candidate.worst = run.sample.worst;
            if (run.sample.holds(options_.error)) return true;
            const int next = std::max(candidate.substeps + 1, int(std::lround(1.3 * candidate.substeps)));
            candidate.why = concat(
                "does not get there: at ", candidate.substeps, " substeps ", run.sample.above, " of ",
                run.sample.molecules, " molecules are above, the worst at ", run.sample.worst,
                run.sample.unknown > 0 ? concat(", and nothing is known of ", run.sample.unknown) : "");
            if (options_.substeps || tries == mostTries || late() || next > maxSubsteps ||
                !run.few->refusal({next, 1}).empty() || !canWin(run, next))
                return false;
            candidate.substeps = next;
        }
    }

    SampleError errorOfSample(Run& run, int substeps) {
        if (!run.all) run.all = std::make_unique<MethodRunner>(all_, run.method, device_);
        run.all->set({substeps, 1});
        run.all->run(frames_);
        const std::vector<Snapshot> ends = run.all->snapshots();
        const double infinite = std::numeric_limits<double>::infinity();
        if (!ExactEnds::finite(ends)) return {.rms = infinite, .worst = infinite};
        return sample_->errorOf(ends);
    }

    // Between substeps that fail (or none) and substeps that do.
    void refine(Run& run, int failed, int good) {
        double error = *run.candidate.error;
        while (failed > 0 && good - failed > 1 && good > closeEnough * failed && !late()) {
            const int middle =
                std::clamp(int(std::lround(std::sqrt(double(failed) * good))), failed + 1, good - 1);
            const double found = run.few->refusal({middle, 1}).empty()
                                     ? measure(run, middle)
                                     : std::numeric_limits<double>::infinity();
            if (found < options_.error) {
                good = middle;
                error = found;
            } else {
                failed = middle;
            }
        }
        run.candidate.substeps = good;
        run.candidate.error = error;
    }

    // Keeps the substeps with the smallest error.
    double measure(Run& run, int substeps) {
        run.few->set({substeps, 1});
        run.few->run(frames_);
        const std::vector<Snapshot> ends = run.few->snapshots();
        const double error =
            ExactEnds::finite(ends) ? sample_->errorOfFew(ends) : std::numeric_limits<double>::infinity();
        Candidate& candidate = run.candidate;
        if (std::isfinite(error) && (!candidate.error || error < *candidate.error)) {
            candidate.error = error;
            candidate.substeps = substeps;
        }
        return error;
    }

    // Returns whether the method can be cheapest. If one look finds it too dear it is timed again, in turn
    // with the best: a busy moment must not decide.
    bool canWin(Run& run, int substeps) {
        Run* best = cheapest();
        if (best == nullptr) return true;
        Candidate& ahead = best->candidate;
        double expected = perVertex(run, run.manyCost.seconds({substeps, 1}));
        if (!losesAgain(
                expected, ahead.cost, [&] { return costAt(run, substeps); },
                [&] { return costAt(*best, ahead.substeps); }))
            return true;
        run.candidate.why =
            concat("cannot win: at ", substeps, substeps == 1 ? " substep" : " substeps", " it costs ",
                   std::round(100 * expected / ahead.cost) / 100, " times the best");
        return false;
    }

    // Times the methods that reach the error again, each in turn with the best: the search timed them one
    // after the other.
    void timeAgain() {
        for (Run& run : runs_) {
            Run* best = cheapest();
            if (best == nullptr || &run == best || !run.candidate.reached || late()) continue;
            if (run.candidate.cost > 3 * best->candidate.cost) continue;
            losesAgain(
                run.candidate.cost, best->candidate.cost, [&] { return costAt(run, run.candidate.substeps); },
                [&] { return costAt(*best, best->candidate.substeps); });
        }
    }

    double perVertex(const Run& run, double secondsOfFrame) const {
        return secondsOfFrame * few_.frameRate / double(run.many->vertices());
    }
    double costAt(Run& run, int substeps) const {
        return perVertex(run, run.many->secondsOfFrame({substeps, 1}));
    }
    Run* cheapest() {
        Run* out = nullptr;
        for (Run& run : runs_)
            if (run.candidate.reached && (out == nullptr || run.candidate.cost < out->candidate.cost))
                out = &run;
        return out;
    }

    Calibration conclude() {
        const Run* best = cheapest();
        const Run* nearest = nullptr;
        for (const Run& run : runs_) {
            const Candidate& candidate = run.candidate;
            if (candidate.error && (nearest == nullptr || *candidate.error < *nearest->candidate.error))
                nearest = &run;
        }
        if (best == nullptr) refuse(nearest == nullptr ? nullptr : &nearest->candidate);
        Calibration out;
        out.target = options_.error;
        out.method = best->candidate.method;
        out.substeps = best->candidate.substeps;
        out.error = *best->candidate.error;
        out.sample = best->sample;
        out.how = sample_->how();
        out.cost = best->candidate.cost;
        int others = 0;
        for (const Run& run : runs_) {
            out.candidates.push_back(run.candidate);
            others += run.candidate.reached && &run != best;
        }
        out.why = others > 0 ? concat("the cheapest of ", others + 1, " that get there")
                             : "the only one that gets there, or the first that nothing else can beat";
        if (late()) out.why += concat("; the search ended after ", *options_.seconds, " s");
        out.duration = frames_ / few_.frameRate;
        if (out.duration < 0.9 * options_.duration)
            out.why += concat(
                "; over more than ", out.duration, " s too many ends are ",
                hurried_ ? "not known in the time given" : "chaotic, too stiff, or finer than floats tell");
        device_.context->checkErrors("calibrate");
        return out;
    }

    [[noreturn]] void refuseForTime(const Candidate* nearest) const {
        std::string found;
        if (nearest != nullptr)
            found = concat("; the nearest by then is ", name(nearest->method.solver), " with ",
                           nearest->substeps, " substeps a frame and ", *nearest->error);
        throw Error(place_,
                    concat("--error ", options_.error, ": no method was found to hold it in ",
                           *options_.seconds, " s: give it more time with ", options_.limitOption, found));
    }

    [[noreturn]] void refuse(const Candidate* nearest) const {
        if (late()) refuseForTime(nearest);
        if (nearest == nullptr)
            throw Error(place_, concat("--error ", options_.error, ": no method can run this scene: ",
                                       runs_.empty() ? "none is left" : runs_.front().candidate.why));
        throw Error(place_, concat("--error ", options_.error,
                                   " is out of reach for a sample of its molecules: the nearest is ",
                                   name(nearest->method.solver), " with ", nearest->substeps,
                                   " substeps a frame, fields by ", name(nearest->method.sampling),
                                   ", which has an error of ", *nearest->error,
                                   nearest->worst ? concat(" RMS and ", *nearest->worst, " at worst") : ""));
    }

    const CalibrationOptions& options_;
    const AccuracyDevice& device_;
    const TimeLimit limit_{options_.seconds};
    const Location place_;
    Scene few_, many_, all_;  // all_: the sample
    int frames_ = 60;
    bool hurried_ = false;  // a longer motion had no time
    std::unique_ptr<MoleculeSample> sample_;
    std::vector<Step> ladder_;
    std::vector<Run> runs_;
};

// Compiles the scene with a fixed solver, so that the plan tells only what is simulated.
Plan plainPlan(const Scene& scene) {
    Scene plain = withMolecules(scene, manyOnGpu);
    plain.solver.kind = SolverKind::bdf2Xpbd;
    plain.solver.substeps = 1;
    plain.solver.fieldSampling = FieldSampling::vertexSubstep;
    return compile(plain);
}

// Whether the key of a scene whose molecules touch has all that moves them.
bool hasWholeKey(Scene scene) {
    for (Group& group : scene.groups)
        group.contact.reset();
    return beyondReference(scene).empty();
}

}  // namespace

Calibration calibrate(const Scene& scene, const CalibrationOptions& options, const AccuracyDevice& device) {
    if (!(options.error > 0 && options.error <= 1))
        throw Error(concat("--error: expected a relative error above 0, at most 1, found ", options.error));
    if (options.error < ExactEnds::floor)
        throw Error(concat("--error ", options.error, " is out of reach: single floats hold the places of a ",
                           "molecule's vertices to about ", ExactEnds::floor, " of its size"));
    const bool touching = std::any_of(scene.groups.begin(), scene.groups.end(),
                                      [](const Group& group) { return group.contact.has_value(); });
    if (!touching) requireReference(scene);
    const Clock::time_point start = Clock::now();
    const std::string key = options.folder.empty() ? "" : calibrationKey(plainPlan(scene), options, device);
    if (std::optional<Calibration> kept = loadCalibration(options.folder, key)) return *kept;
    std::optional<Search> search;
    bool whole = false;
    Calibration out = touching ? calibrateContact(scene, options, device, whole)
                               : search.emplace(scene, options, device).run();
    whole = search ? !search->late() && !search->hurried() : whole && hasWholeKey(scene);
    out.seconds = secondsSince(start);
    if (whole) keepCalibration(options.folder, key, out);
    return out;
}

void apply(const Calibration& calibration, Scene& scene) {
    if (calibration.contact) {
        scene.solver.substeps = calibration.substeps;
        scene.contact.iterations = calibration.contact->iterations;
        return;
    }
    scene.solver.kind = calibration.method.solver;
    scene.solver.fieldSampling = calibration.method.sampling;
    scene.solver.substeps = calibration.substeps;
}

}  // namespace shoal::measure
