// The sweep: probe every method, solve the reference, run the ladder of steps level by level until each
// method has passed its smallest error, time what was run, in turn.
#include "measure/accuracy.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace shoal::measure {

namespace {

constexpr double firstTolerance = 1e-5;  // of the reference, until errors come nearer
constexpr double shareOfError = 0.01;    // of the smallest error: the reference's

// By which share of the time that is given a stage ends.
constexpr double byProbes = 0.2, byExtra = 0.3, byReference = 0.65, byErrors = 0.8;

struct Curve : MethodOnBoth {
    FrameCost fewCost;
    double fewStep = 0, manyStep = 0;  // s, that setting another step takes
    std::vector<AccuracyPoint> points;
    std::vector<std::vector<Snapshot>> ends;  // of the points' few molecules; empty: none
    SmallestError smallest;
    bool done = false;
};

class Sweep {
  public:
    Sweep(const Scene& scene, const AccuracyOptions& options, const AccuracyDevice& device,
          const AccuracyProgress& progress)
        : options_(options),
          device_(device),
          progress_(progress),
          few_(withMolecules(scene, options.molecules)),
          many_(withMolecules(scene, options.timedMolecules)),
          ladder_(stepLadder(options.mostSplits)) {
        frames_ = std::max(1, int(std::lround(options.duration * scene.frameRate)));
        out_.scene = scene.name;
        out_.frameRate = scene.frameRate;
        out_.duration = frames_ / scene.frameRate;
    }

    AccuracyReport run() {
        for (const Method& method : methodsInTurn(few_, options_.solvers, options_.samplings)) {
            probe(curves_.emplace_back(), method);
            tell(0);
        }
        if (std::all_of(curves_.begin(), curves_.end(), [](const Curve& c) { return !c.refused.empty(); }))
            throw Error(concat("no method can run this scene: ", curves_.front().refused));
        describe();
        estimate();
        stage("calibration", expectedOfExtra_);
        std::vector<std::pair<Method, Step>> extras;
        if (options_.extra) {
            std::optional<double> most;
            if (options_.seconds) most = limit_.left(byExtra);
            extras = options_.extra(most);
            if (limit_.over(byExtra)) cut_.push_back("the choice of a method ended early");
        }
        stage("reference", std::min(reference_->secondsToSolve(), limit_.left(byReference)));
        solveReference();
        stage("errors", 0);
        const double all = secondsOfErrorsAndTimes(), left = std::min(all, limit_.left());
        progress_.left(left, left / all);
        for (const Step& step : ladder_)
            for (Curve& curve : curves_)
                level(curve, step);
        for (const auto& [method, step] : extras)
            extra(method, step);
        stage("reference", 0);
        tighten();
        stage("times", 0);
        time();
        return finish();
    }

  private:
    void probe(Curve& curve, const Method& method) {
        curve.method = method;
        curve.done = true;
        if (reference_ && limit_.over(byProbes)) {
            add(curve, ladder_.front()).why = curve.refused = "there was no time to make it ready";
            ++unready_;
            return;
        }
        static_cast<MethodOnBoth&>(curve) = makeReady(method, few_, many_, ladder_, device_);
        limit_.leaveOut(curve.compiling);
        if (!curve.refused.empty()) return refuse(curve, ladder_.front(), curve.refused);
        curve.done = false;
        curve.few->restart();
        if (!reference_)
            reference_ =
                std::make_unique<ExactEnds>(few_, curve.few->simulation().plan(), curve.few->snapshots(),
                                            out_.duration, device_.cores, options_.molecules);
        curve.fewCost = frameCost(*curve.few);
        curve.fewStep = secondsOfStep(*curve.few, curve.fewCost);
        curve.manyStep = secondsOfStep(*curve.many, curve.manyCost);
        out_.path = curve.few->simulation().path().path;
    }

    // To a step that has not been set before, as the next ones will not have been.
    static double secondsOfStep(MethodRunner& runner, const FrameCost& cost) {
        constexpr Step other{8, 1};
        runner.set(other);
        const double seconds = runner.warmUp();
        return std::max(0.0, seconds - cost.seconds(other));
    }

    void describe() {
        for (const Curve& curve : curves_) {
            if (!curve.refused.empty()) continue;
            for (const GroupPlan& plan : curve.few->simulation().plan().groups) {
                const Group& group = few_.groups[plan.index];
                out_.groups.push_back({plan.name, group.molecule.name, plan.vertexCount, plan.springCount,
                                       plan.count, many_.groups[plan.index].count, plan.size,
                                       plan.highestFrequency});
            }
            return;
        }
    }

    void estimate() {
        const double sweep = secondsOfErrorsAndTimes();
        if (options_.extra)
            expectedOfExtra_ = std::min(reference_->secondsToSolve(3) + 0.05 * sweep, limit_.left(byExtra));
        expected_ = std::min(sweep + expectedOfExtra_ + reference_->secondsToSolve(), limit_.left());
        progress_.estimate(expected_);
    }

    // Ends the stage before, whatever it took, as what it was expected to take.
    void stage(const char* words, double expected) {
        tell(expectedOfStage_);
        expectedOfStage_ = expected;
        progress_.stage(words);
    }

    // Fewer molecules, each of which has the time that it needs, tell more than all without a reference.
    void takeFewerMolecules() {
        const double share = limit_.left(byReference) / reference_->secondsToSolve();
        const int most =
            std::max(std::min(device_.cores, options_.molecules), int(share * options_.molecules));
        const auto first = std::find_if(curves_.begin(), curves_.end(),
                                        [](const Curve& curve) { return curve.refused.empty(); });
        first->few->restart();
        reference_ = std::make_unique<ExactEnds>(few_, first->few->simulation().plan(),
                                                 first->few->snapshots(), out_.duration, device_.cores, most);
        for (AccuracyGroup& group : out_.groups)
            group.measured = std::min(group.measured, most);
        cut_.push_back(concat("errors are of ", most, " molecules of a group at most"));
    }

    void solveReference() {
        if (reference_->secondsToSolve() > limit_.left(byReference)) takeFewerMolecules();
        settled_ = reference_->solve(firstTolerance, reference_->secondsEach(limit_.left(byReference)));
        if (settled_ != Settled::yes && limit_.over(byReference)) cut_.push_back("the reference ended early");
        if (settled_ == Settled::chaotic) out_.chaotic = reference_->why();
        if (settled_ != Settled::tooStiff) return;
        out_.tooStiff = reference_->why();
        if (limit_.over(byReference))
            out_.tooStiff = concat("--seconds leaves too little time: ", out_.tooStiff);
    }

    double secondsOf(const Curve& curve, const Step& step) const {
        return curve.fewStep + curve.fewCost.seconds(step) * (frames_ * step.split + 1);
    }
    static Contender contender(Curve& curve, const Step& step) {
        return {curve.many.get(), step, curve.manyCost.seconds(step), curve.manyStep};
    }
    double secondsOfErrorsAndTimes() {
        double errors = 0;
        std::vector<Contender> timed;
        for (Curve& curve : curves_) {
            for (const Step& step : ladder_) {
                if (curve.done || step.split > 1) continue;
                errors += secondsOf(curve, step);
                timed.push_back(contender(curve, step));
            }
        }
        return errors + leastSeconds(timed);
    }

    AccuracyPoint& add(Curve& curve, const Step& step) {
        AccuracyPoint& point = curve.points.emplace_back();
        curve.ends.emplace_back();
        point.method = curve.method;
        point.step = step;
        point.stepsPerSecond = out_.frameRate * step.perFrame();
        return point;
    }
    void refuse(Curve& curve, const Step& step, const std::string& why) {
        AccuracyPoint& point = add(curve, step);
        point.outcome = Outcome::refused;
        point.why = why;
    }

    void level(Curve& curve, const Step& step) {
        if (curve.done) return;
        // beyond the most substeps of a frame only who needs them
        if (step.split > 1 && (curve.smallest.error <= options_.enough || !out_.hasErrors())) {
            curve.done = true;
            return;
        }
        const std::string refusal = curve.few->refusal(step);
        if (!refusal.empty()) return refuse(curve, step, refusal);
        if (const std::optional<Step> longest = longestTaken(curve, step)) measure(curve, *longest);
        if (curve.done) return;
        const double seconds = secondsOf(curve, step);
        if (measured_ > 0 && seconds > limit_.left(byErrors)) {
            AccuracyPoint& point = add(curve, step);
            point.why = concat("this and what is finer would take ", seconds, " s and more");
            curve.done = true;
            ++endedEarly_;
            return;
        }
        measure(curve, step);
        tell(seconds);
    }

    // The longest step that a method takes, where the ladder goes past it: between the last that was refused
    // and this one.
    static std::optional<Step> longestTaken(const Curve& curve, const Step& step) {
        if (curve.points.empty() || curve.points.back().outcome != Outcome::refused) return {};
        const int most = step.perFrame() / step.split;
        int refused = curve.points.back().step.perFrame() / step.split, taken = most;
        while (taken - refused > 1) {
            const int middle = (refused + taken) / 2;
            (curve.few->refusal({middle, step.split}).empty() ? taken : refused) = middle;
        }
        if (taken == most) return {};
        return Step{taken, step.split};
    }

    void measure(Curve& curve, const Step& step) {
        AccuracyPoint& point = add(curve, step);
        curve.few->set(step);
        ++measured_;
        if (!out_.hasErrors()) {
            point.outcome = Outcome::measured;
            return;
        }
        curve.few->warmUp();
        curve.few->run(frames_);
        std::vector<Snapshot> ends = curve.few->snapshots();
        if (!ExactEnds::finite(ends)) {
            point.outcome = Outcome::notFinite;
            point.why = "positions or velocities are no numbers any more";
            return;
        }
        point.outcome = Outcome::measured;
        point.error = reference_->errorOf(ends);
        curve.ends.back() = std::move(ends);
        if (curve.smallest.isPassedBy(point.error->total)) curve.done = true;
    }

    void extra(const Method& method, const Step& step) {
        for (Curve& curve : curves_) {
            if (curve.method != method || !curve.refused.empty()) continue;
            const bool known = std::any_of(curve.points.begin(), curve.points.end(),
                                           [&](const AccuracyPoint& p) { return p.step == step; });
            if (!known && curve.few->refusal(step).empty()) measure(curve, step);
        }
    }

    // The reference must be much nearer than the nearest method.
    void tighten() {
        if (!out_.hasErrors()) return;
        double smallest = 1e30;
        for (const Curve& curve : curves_)
            smallest = std::min(smallest, curve.smallest.error);
        // what ran out of time once would do so again
        const bool near = reference_->error() <= shareOfError * smallest;
        if (!near && settled_ == Settled::yes)
            settled_ =
                reference_->solve(shareOfError * smallest, reference_->secondsEach(limit_.left(byErrors)));
        if (!near && settled_ != Settled::yes)
            out_.notes.push_back(concat(
                "errors below ", formatted("%.1e", reference_->error() / shareOfError),
                " may be off by more than ", 100 * shareOfError, " % of themselves: ", reference_->why()));
        out_.referenceError = reference_->error();
        for (Curve& curve : curves_) {
            for (size_t i = 0; i < curve.points.size(); ++i) {
                if (curve.ends[i].empty()) continue;
                curve.points[i].error = reference_->errorOf(curve.ends[i]);
                curve.points[i].drift = reference_->driftOf(curve.ends[i]);
            }
        }
    }

    void time() {
        std::vector<Contender> contenders;
        std::vector<AccuracyPoint*> points;
        for (Curve& curve : curves_) {
            for (AccuracyPoint& point : curve.points) {
                if (point.outcome != Outcome::measured) continue;
                contenders.push_back(contender(curve, point.step));
                points.push_back(&point);
            }
        }
        std::optional<double> left;
        if (options_.seconds) left = limit_.left();
        const double before = done_;
        const std::vector<Spread> times = timeInTurn(contenders, left, [&](double seconds) {
            done_ = before + seconds;
            progress_.tell(shareDone());
        });
        int without = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            without += times[i].samples == 0;
            const double vertices = double(contenders[i].runner->vertices());
            const double factor = out_.frameRate * points[i]->step.split / vertices;
            points[i]->time = {times[i].min * factor, times[i].median * factor, times[i].samples};
            points[i]->stateBytes = contenders[i].runner->simulation().stateBytes();
        }
        if (without > 0)
            cut_.push_back(concat(without, " of ", points.size(), " points, the dearest, were not timed"));
    }

    void tellWhatWasCut() {
        if (unready_ > 0)
            cut_.insert(cut_.begin(), concat(unready_, " of ", curves_.size(), " methods were not tried"));
        if (endedEarly_ > 0)
            cut_.push_back(
                concat("finer steps of ", many(endedEarly_, "method", "methods"), " were not tried"));
        if (!cut_.empty())
            out_.notes.push_back(
                concat("--seconds ", *options_.seconds, " is too short for all of it: ", joined(cut_, ", ")));
    }

    AccuracyReport finish() {
        tellWhatWasCut();
        for (const Curve& curve : curves_)
            out_.points.insert(out_.points.end(), curve.points.begin(), curve.points.end());
        std::stable_sort(
            out_.points.begin(), out_.points.end(), [](const AccuracyPoint& a, const AccuracyPoint& b) {
                return std::tie(a.method, a.stepsPerSecond) < std::tie(b.method, b.stepsPerSecond);
            });
        markFront(out_.points);
        device_.context->checkErrors("measure");
        out_.seconds = secondsSince(start_);
        return std::move(out_);
    }

    double shareDone() const { return std::min(1.0, done_ / std::max(expected_, 1e-9)); }
    void tell(double seconds) {
        done_ += seconds;
        progress_.tell(shareDone());
    }

    const AccuracyOptions& options_;
    const AccuracyDevice& device_;
    const AccuracyProgress& progress_;
    Scene few_, many_;
    std::vector<Step> ladder_;
    int frames_ = 60;
    std::vector<Curve> curves_;
    std::unique_ptr<ExactEnds> reference_;
    AccuracyReport out_;
    Settled settled_ = Settled::yes;                    // the reference
    double expected_ = 0, done_ = 0;                    // s
    double expectedOfExtra_ = 0, expectedOfStage_ = 0;  // s
    int unready_ = 0, endedEarly_ = 0;                  // curves
    int measured_ = 0;                                  // points
    std::vector<std::string> cut_;                      // for want of time
    Clock::time_point start_ = Clock::now();
    TimeLimit limit_{options_.seconds};
};

}  // namespace

const char* name(Outcome outcome) {
    static constexpr const char* names[] = {"measured", "refused", "not finite", "left out"};
    return names[size_t(outcome)];
}

AccuracyReport measureAccuracy(const Scene& scene, const AccuracyOptions& options,
                               const AccuracyDevice& device, const AccuracyProgress& progress) {
    requireReference(scene);
    AccuracyReport out = Sweep(scene, options, device, progress).run();
    for (const Group& group : scene.groups)
        if (group.release)
            out.notes.push_back(concat("\"", group.name.empty() ? group.molecule.name : group.name,
                                       "\": pins are held throughout, though the scene lets them go"));
    return out;
}

}  // namespace shoal::measure
