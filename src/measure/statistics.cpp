#include "measure/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/contract.h"
#include "core/parallel.h"
#include "core/random.h"
#include "gpu/gl.h"

namespace shoal::measure {

namespace {

constexpr int finer = 8;               // times the scene's substeps: the reference on the device
constexpr int mostMolecules = 64;      // of a group, in double precision
constexpr double usualSeconds = 60;    // of the reference in double precision
constexpr double sharedByFirst = 0.6;  // of the time: all but finer steps of the reference
constexpr int mostHalvings = 3;        // of its step, after the first
constexpr double negligible = 1e-3;    // share of a scale
// Shares of a molecule's size, and rad, by which starts are displaced: less than shows; and so little that a
// stack stays one. m.
constexpr double displacedFreely = 0.01, displacedInContact = 1e-6, leastDisplacement = 1e-8;

// A solver, or the scene's choice, at a number of substeps.
struct Contestant {
    std::optional<SolverKind> kind;
    int substeps = 1;
    int contactSteps = 0;  // 0: one a substep
    bool rests = true;     // what lies still may be left out, where the scene says so
};

bool isFinite(const std::vector<Snapshot>& ends) {
    return ExactEnds::finite(ends);
}

std::string solversOf(const Plan& plan) {
    std::vector<std::string> names;
    for (const GroupPlan& group : plan.groups)
        if (const char* name = shoal::name(group.solver); !std::count(names.begin(), names.end(), name))
            names.emplace_back(name);
    return joined(names, ", ");
}

Snapshot startOf(const GroupPlan& group) {
    Snapshot out;
    out.count = group.count;
    out.vertexCount = group.vertexCount;
    out.velocities.assign(group.start.velocities.begin(), group.start.velocities.end());
    for (size_t i = 0; i < group.start.positions.size(); ++i)
        out.positions.push_back(glm::dvec3(group.start.anchors[i / size_t(group.vertexCount)]) +
                                glm::dvec3(group.start.positions[i]));
    return out;
}

bool sameStart(const Plan& a, const Plan& b) {
    for (size_t g = 0; g < a.groups.size(); ++g) {
        const GroupPlan &first = a.groups[g], &other = b.groups[g];
        if (first.needs.life || first.start.positions != other.start.positions ||
            first.start.anchors != other.start.anchors || first.start.velocities != other.start.velocities ||
            first.constants.scales != other.constants.scales ||
            first.constants.phases != other.constants.phases)
            return false;
    }
    return true;
}

// Moves and turns each molecule as a whole, in directions drawn by the seed.
void displace(Plan& plan, double share, uint64_t seed) {
    for (GroupPlan& group : plan.groups) {
        Random random(seed, group.index);
        const auto vertices = ptrdiff_t(group.vertexCount);
        for (int m = 0; m < group.count; ++m) {
            const double size = (group.size > 0 ? group.size : 1) * double(group.constants.scales[size_t(m)]);
            const glm::vec3 away(std::max(share * size, leastDisplacement) * random.direction());
            const glm::mat3 turn(glm::mat3_cast(glm::angleAxis(share, random.direction())));
            const auto turnAbout = [&](std::vector<glm::vec3>& vectors, const glm::vec3& shift) {
                const auto first = vectors.begin() + m * vertices, last = first + vertices;
                const glm::vec3 mean = std::accumulate(first, last, glm::vec3(0)) / float(vertices);
                std::for_each(first, last,
                              [&](glm::vec3& vector) { vector = mean + turn * (vector - mean) + shift; });
            };
            turnAbout(group.start.positions, away);
            turnAbout(group.start.velocities, glm::vec3(0));
        }
    }
}

// A molecule of the reference in double precision.
struct ExactRun {
    size_t group = 0;
    reference::Problem problem;
    reference::State start, coarse, fine;
};

class Study {
  public:
    Study(const Scene& scene, const StatisticsOptions& options, const AccuracyDevice& device)
        : options_(options), device_(device), scene_(scene), limit_(options.seconds) {
        frames_ = std::max(1, int(std::lround(options.duration * scene.frameRate)));
        out_.scene = scene.name;
        out_.frameRate = scene.frameRate;
        out_.firstSeed = scene.seed;
        out_.duration = frames_ / scene.frameRate;
        usual_ = {scene.solver.kind, scene.solver.substeps, scene.contact.steps};
    }

    StatisticsReport run() {
        chooseContestants();
        const Plan first = anyPlan();
        if (std::all_of(first.groups.begin(), first.groups.end(),
                        [](const GroupPlan& group) { return group.isStill(); }))
            throw Error(Location{scene_.file, 0, 0, {}}, "nothing in the scene moves: it has no statistics");
        chooseReference();
        shareLists();
        if (sameStart(planOf(contestants_[ready_], out_.firstSeed),
                      planOf(contestants_[ready_], out_.firstSeed + 1)))
            out_.displaced = first.contact.any() ? displacedInContact : displacedFreely;
        describe();
        for (int i = 0; i < options_.seeds; ++i) {
            if (i >= 2 && secondsSince(start_) / i > limit_.left(shareOfSeeds())) break;
            runSeed(i);
            out_.seeds = i + 1;
            options_.tell(shareOfSeeds() * (i + 1) / options_.seeds);
        }
        judge();
        for (int halving = 0; mayHalve(halving); ++halving)
            halve();
        return finish();
    }

  private:
    double shareOfSeeds() const { return out_.reference.isDouble ? sharedByFirst : 1; }

    Plan planOf(const Contestant& contestant, uint64_t seed) {
        scene_.seed = seed;
        scene_.solver.kind = contestant.kind;
        scene_.solver.substeps = contestant.substeps;
        scene_.contact.steps = contestant.contactSteps;
        scene_.contact.rest = contestant.rests ? rest_ : std::nullopt;
        for (const auto& [g, places] : lists_) {
            Group& group = scene_.groups[g];
            const size_t first = (seed - out_.firstSeed) * uint64_t(group.count) % places.size();
            std::rotate_copy(places.begin(), places.begin() + ptrdiff_t(first), places.end(),
                             group.place.items.begin());
        }
        Plan out = compile(scene_);
        if (out_.displaced > 0) displace(out, out_.displaced, seed);
        return out;
    }
    // Starts do not depend on the method.
    Plan anyPlan() { return planOf(contestants_[ready_], scene_.seed); }

    void chooseContestants() {
        std::vector<std::optional<SolverKind>> kinds(options_.solvers.begin(), options_.solvers.end());
        std::vector<int> substeps = options_.substeps;
        if (kinds.empty()) kinds = {usual_.kind};
        if (substeps.empty()) substeps = {usual_.substeps};
        std::optional<size_t> ready;
        for (const std::optional<SolverKind>& kind : kinds) {
            for (const int each : substeps) {
                contestants_.push_back({kind, each, usual_.contactSteps});
                StatisticsMethod& method = out_.methods.emplace_back();
                method.substeps = each;
                method.solver = kind ? shoal::name(*kind) : "auto";
                try {
                    method.solver = solversOf(planOf(contestants_.back(), out_.firstSeed));
                    if (!ready) ready = contestants_.size() - 1;
                } catch (const Error& error) {
                    refuse(method, error);
                }
            }
        }
        if (!ready) throw Error(concat("no method can run this scene: ", out_.methods.front().why));
        ready_ = *ready;
    }

    static void refuse(StatisticsMethod& method, const Error& error) {
        method.outcome = Outcome::refused;
        method.why = error.message();
    }

    // ---- The reference

    void chooseReference() {
        StatisticsReference& reference = out_.reference;
        reference.why = beyondReference(scene_);
        reference.isDouble = reference.why.empty();
        if (!reference.isDouble) return chooseFineSteps();
        reference.solver = "Runge-Kutta of order 4";
        const int most = moleculesThatFit();
        scene_ = withMolecules(std::move(scene_), most);
    }

    // The reference runs as many as its seconds allow, each at its first step and half of it.
    int moleculesThatFit() {
        if (options_.molecules) return *options_.molecules;
        const double seconds = std::min(usualSeconds, limit_.left(sharedByFirst / 2));
        const Plan plan = anyPlan();
        double each = 0;  // s, of one molecule of each group and all seeds
        for (const GroupPlan& group : plan.groups) {
            if (group.count == 0) continue;
            const reference::Problem problem = problemIn(group, 0);
            const reference::State state = ExactEnds::stateOf(startOf(group), 0);
            each += 3 * double(firstSteps(problem)) * secondsOfStep(problem, state, out_.duration) *
                    options_.seeds / device_.cores;
        }
        return std::clamp(int(seconds / std::max(each, 1e-9)), 4, mostMolecules);
    }

    reference::Problem problemIn(const GroupPlan& plan, int m) const {
        return problemOf(scene_, scene_.groups[plan.index], double(plan.constants.scales[size_t(m)]),
                         double(plan.constants.phases[size_t(m)]));
    }

    // The reference takes as many as the finest method, and more where springs or drag need them.
    int64_t firstSteps(const reference::Problem& problem) const {
        int substeps = 1;
        for (const Contestant& contestant : contestants_)
            substeps = std::max(substeps, contestant.substeps);
        return std::max(reference::firstSteps(problem, out_.duration), int64_t(substeps) * frames_);
    }

    // Leapfrog, or where it is not stable in so many substeps, what the scene runs as.
    void chooseFineSteps() {
        int substeps = finer * usual_.substeps;
        for (const Contestant& contestant : contestants_)
            substeps = std::max(substeps, 4 * contestant.substeps);
        while (substeps <= maxSubsteps && !takes(withSubsteps(SolverKind::leapfrog, substeps / 2)))
            substeps *= 2;
        fine_ = withSubsteps(SolverKind::leapfrog, substeps);
        if (!takes(fine_) || !takes(half())) fine_ = withSubsteps(usual_.kind, finer * usual_.substeps);
        const Plan plan = planOf(fine_, out_.firstSeed);
        out_.reference.solver = solversOf(plan);
        out_.reference.substeps = fine_.substeps;
        out_.reference.step = 1 / scene_.frameRate / fine_.substeps;
    }
    // Contact keeps its share of them, and nothing rests.
    Contestant withSubsteps(std::optional<SolverKind> kind, int substeps) const {
        substeps = std::min(substeps, maxSubsteps);
        return {kind, substeps, usual_.contactSteps * substeps / usual_.substeps, false};
    }
    Contestant half() const { return withSubsteps(fine_.kind, std::max(1, fine_.substeps / 2)); }
    bool takes(const Contestant& contestant) {
        try {
            planOf(contestant, out_.firstSeed);
            return true;
        } catch (const Error&) {
            return false;
        }
    }

    // Where a list has places for all runs, each run takes others.
    void shareLists() {
        for (size_t g = 0; g < scene_.groups.size(); ++g) {
            const Group& group = scene_.groups[g];
            const size_t all = size_t(group.count) * size_t(options_.seeds);
            if (group.place.kind == Placement::Kind::list && group.place.items.size() >= all)
                lists_.emplace_back(g, group.place.items);
        }
        if (!lists_.empty()) out_.notes.push_back("each run takes the next places of a list");
    }

    void describe() {
        scene_.seed = out_.firstSeed;
        for (const GroupPlan& plan : anyPlan().groups)
            out_.groups.push_back(
                {plan.name, scene_.groups[plan.index].molecule.name, plan.count, plan.vertexCount});
    }

    // ---- Runs

    void add(Ensemble& ensemble, const Plan& plan, const std::vector<Snapshot>& ends) const {
        for (size_t g = 0; g < ends.size(); ++g)
            ensemble.add(plan.groups[g].name, quantitiesOf(scene_, plan.groups[g], ends[g]));
    }

    void runSeed(int i) {
        const uint64_t seed = out_.firstSeed + uint64_t(i);
        if (out_.reference.isDouble)
            runExactly(seed, 1, coarse_, &out_.reference.ensemble);
        else
            for (const auto& [contestant, ensemble] :
                 {std::pair{half(), &coarse_}, {fine_, &out_.reference.ensemble}})
                if (!runOnDevice(contestant, seed, *ensemble)) notFinite();
        for (size_t c = 0; c < contestants_.size(); ++c) {
            StatisticsMethod& method = out_.methods[c];
            if (method.outcome != Outcome::measured) continue;
            try {
                if (runOnDevice(contestants_[c], seed, method.ensemble)) continue;
                method.outcome = Outcome::notFinite;
                method.why = concat("positions or velocities are no numbers any more with the seed ", seed);
            } catch (const Error& error) {
                refuse(method, error);  // by the path, the driver or the device's memory
            }
        }
    }
    static void notFinite() {
        throw Error("the reference has no finite end: there is nothing to compare with");
    }

    bool runOnDevice(const Contestant& contestant, uint64_t seed, Ensemble& ensemble) {
        Simulation simulation(*device_.context, planOf(contestant, seed), simulationOptions(device_));
        out_.path = simulation.path().path;
        for (int frame = 0; frame < frames_; ++frame)
            simulation.frame();
        glFinish();
        std::vector<Snapshot> ends;
        for (size_t g = 0; g < simulation.plan().groups.size(); ++g)
            ends.push_back(simulation.snapshot(g));
        if (!isFinite(ends)) return false;
        add(ensemble, simulation.plan(), ends);
        return true;
    }

    // Each molecule with `factor` times its first number of steps, into `coarse` where that is wanted, and
    // with twice as many.
    void runExactly(uint64_t seed, int64_t factor, Ensemble& ensemble, Ensemble* twice) {
        const Plan plan = planOf(contestants_[ready_], seed);
        std::vector<ExactRun> runs;
        std::vector<Snapshot> ends;
        for (size_t g = 0; g < plan.groups.size(); ++g) {
            ends.push_back(startOf(plan.groups[g]));
            ends.back().time = out_.duration;
            for (int m = 0; m < plan.groups[g].count; ++m) {
                ExactRun& run = runs.emplace_back();
                run.group = g;
                run.problem = problemIn(plan.groups[g], m);
                run.start = ExactEnds::stateOf(ends.back(), m);
                run.start.time = 0;
            }
        }
        std::vector<double> steps(runs.size());
        parallel(int(runs.size()), device_.cores, [&](int r) {
            ExactRun& run = runs[size_t(r)];
            const int64_t first = factor * firstSteps(run.problem);
            run.coarse = reference::integrate(run.problem, run.start, out_.duration, first);
            if (twice) run.fine = reference::integrate(run.problem, run.start, out_.duration, 2 * first);
            steps[size_t(r)] = out_.duration / double(twice ? 2 * first : first);
        });
        out_.reference.step = *std::max_element(steps.begin(), steps.end());
        addExact(plan, ends, runs, &ExactRun::coarse, ensemble);
        if (twice) addExact(plan, ends, runs, &ExactRun::fine, *twice);
    }
    void addExact(const Plan& plan, std::vector<Snapshot>& ends, const std::vector<ExactRun>& runs,
                  reference::State ExactRun::*end, Ensemble& ensemble) const {
        std::vector<size_t> next(ends.size(), 0);
        for (const ExactRun& run : runs) {
            const reference::State& state = run.*end;
            size_t& first = next[run.group];
            std::copy(state.position.begin(), state.position.end(),
                      ends[run.group].positions.begin() + ptrdiff_t(first));
            std::copy(state.velocity.begin(), state.velocity.end(),
                      ends[run.group].velocities.begin() + ptrdiff_t(first));
            first += state.position.size();
        }
        if (!isFinite(ends)) notFinite();
        add(ensemble, plan, ends);
    }

    // ---- Whether the reference's step is short enough

    // A statistic is known as well as its own interval tells; what halving the step changes has to be less,
    // or not to be told from nothing, or too little for anyone.
    void judge() {
        StatisticsReference& reference = out_.reference;
        reference.halving = compare(coarse_, reference.ensemble, out_.seeds);
        reference.worst = worstOf(reference.halving);
        reference.settled =
            std::all_of(reference.halving.begin(), reference.halving.end(), [](const Difference& change) {
                return change.verdict != Verdict::differs ||
                       std::abs(change.difference.mean) <= change.reference.half ||
                       (change.scale && *change.relative() <= negligible);
            });
        secondsOfSeeds_ = secondsSince(start_);
    }
    bool mayHalve(int halving) const {
        const double seconds = double(int64_t(2) << halving) * secondsOfSeeds_;
        return out_.reference.isDouble && !out_.reference.settled && halving < mostHalvings &&
               seconds < std::min(limit_.left(), 2 * usualSeconds);
    }
    void halve() {
        factor_ *= 2;  // the last fine steps are the coarse ones now
        coarse_ = std::exchange(out_.reference.ensemble, {});
        for (int i = 0; i < out_.seeds; ++i)
            runExactly(out_.firstSeed + uint64_t(i), 2 * factor_, out_.reference.ensemble, nullptr);
        const double before = secondsOfSeeds_;
        judge();
        secondsOfSeeds_ = before;
    }

    StatisticsReport finish() {
        for (StatisticsMethod& method : out_.methods) {
            if (method.outcome != Outcome::measured) continue;
            method.differences = compare(out_.reference.ensemble, method.ensemble, out_.seeds);
            method.worst = worstOf(method.differences);
            method.within = withinOf(method.differences);
        }
        if (out_.seeds < options_.seeds)
            out_.notes.push_back(concat("--seconds ", *options_.seconds, " is too short for all of it: ",
                                        out_.seeds, " of ", options_.seeds, " seeds"));
        if (out_.seeds < claimedSeeds)
            out_.notes.push_back(concat("the intervals of ", out_.seeds, " seeds are wide: a claim takes ",
                                        claimedSeeds, " and more"));
        if (!out_.reference.settled)
            out_.notes.push_back(
                "the reference has not converged: halving its step still changes its "
                "statistics by more than their intervals");
        options_.tell(1);
        device_.context->checkErrors("measure");
        out_.seconds = secondsSince(start_);
        return std::move(out_);
    }

    const StatisticsOptions& options_;
    const AccuracyDevice& device_;
    Scene scene_;  // with the solver and the seed of whatever is compiled
    TimeLimit limit_;
    Clock::time_point start_ = Clock::now();
    int frames_ = 60;
    std::vector<std::pair<size_t, std::vector<Placement::Item>>> lists_;  // of groups that take turns
    std::optional<double> rest_ = scene_.contact.rest;                    // m/s
    Contestant usual_, fine_;
    std::vector<Contestant> contestants_;  // as many as methods
    size_t ready_ = 0;                     // the first that compiles
    Ensemble coarse_;                      // of the reference at twice its step
    int64_t factor_ = 1;                   // times the first number of steps: of `coarse_`
    double secondsOfSeeds_ = 0;
    StatisticsReport out_;
};

}  // namespace

StatisticsReport measureStatistics(const Scene& scene, const StatisticsOptions& options,
                                   const AccuracyDevice& device) {
    EXPECTS(options.seeds >= 2);
    if (scene.groups.empty())
        throw Error(Location{scene.file, 0, 0, {}}, "the scene has no molecules to measure");
    return Study(scene, options, device).run();
}

}  // namespace shoal::measure
