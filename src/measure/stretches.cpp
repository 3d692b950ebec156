#include "measure/stretches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/gl.h"
#include "scene/force_kinds.h"

namespace shoal::measure {

namespace {

constexpr double finest = 1e-5;    // no reference is nearer: what floats hold over a second
constexpr double stale = 10;       // s on the clock, after which another stretch is begun
constexpr double mostSeconds = 1;  // of a molecule, which closing waits for

// Whether the reference knows what acts: no force is held by hand.
bool known(const Plan& plan, const Parameters& parameters) {
    for (size_t i = 0; i < parameters.forces.size(); ++i)
        if (parameters.forces[i].position || (plan.forces[i].mouse && parameters.forces[i].on)) return false;
    return true;
}

}  // namespace

MoleculeRange MovingSample::next() {
    const MoleculeRange out{std::min(first_, count_ - size_), size_};
    first_ = first_ + size_ >= count_ ? 0 : first_ + size_;
    return out;
}

std::vector<SampledState> readSample(const Simulation& simulation, size_t group, const MoleculeRange& range) {
    if (range.count == 0) return {};
    const GroupPlan& plan = simulation.plan().groups[group];
    const GroupState read = simulation.readMolecules(group, size_t(range.first), size_t(range.count));
    const size_t vertices = size_t(plan.vertexCount);
    std::vector<SampledState> out(size_t(range.count));
    for (size_t m = 0; m < out.size(); ++m) {
        out[m].scale = double(read.looks[m].x);
        out[m].phase = double(read.looks[m].y);
        out[m].alive = read.lives.empty() || read.lives[m].x < read.lives[m].y;
        out[m].released = read.released[m] != 0;
        out[m].state.time = simulation.time();
        for (size_t v = m * vertices; v < (m + 1) * vertices; ++v) {
            out[m].state.position.push_back(glm::dvec3(read.anchors[m]) + glm::dvec3(read.positions[v]));
            out[m].state.velocity.emplace_back(read.velocities[v]);
        }
    }
    return out;
}

// The equations of a group's molecules. One reference at a time has it.
struct Stretches::GroupReference {
    GroupReference(const Scene& scene, const Group& group)
        : molecule(group.molecule), held(group.held), base(problemOf(scene, group, 1, 0)) {
        base.molecule = &molecule;
        for (size_t i = 0; i < scene.forces.size(); ++i)
            if (actsOn(scene.forces[i], group.name)) forces.push_back(i);
    }

    // Returns the equations with these factors.
    reference::Problem& scaledBy(const Parameters& factors) {
        if (problem && factors == parameters) return *problem;
        parameters = factors;
        problem = base;
        problem->gravity = factors.gravity;
        problem->stiffness *= factors.stiffness;
        problem->damping *= factors.damping;
        problem->drag.normal *= factors.drag;
        problem->drag.tangent *= factors.drag;
        for (size_t i = 0; i < problem->fields.size(); ++i)
            problem->fields[i].weight *= factors.wind * (i < factors.fields.size() ? factors.fields[i] : 1);
        for (size_t i = 0; i < forces.size(); ++i) {
            const ForceControl& control = factors.forces[forces[i]];
            ForceShape& shape = *problem->forces[i].shape;
            const double factor = control.on ? control.factor : 0;
            shape = std::visit([&](const auto& kind) { return ForceShape(kind.times(factor)); }, shape);
        }
        return *problem;
    }

    Molecule molecule;
    bool held;
    reference::Problem base;
    std::vector<size_t> forces;  // their numbers in the scene
    std::optional<reference::Problem> problem;
    Parameters parameters;
};

struct Stretches::Open {
    double start = 0;  // s
    std::vector<MoleculeRange> ranges;
    std::vector<std::vector<SampledState>> molecules;  // of each group
};

struct Stretches::Ended {
    size_t group = 0;
    int molecule = 0;
    SampledState start;
    reference::State end;
    Parameters parameters;
};

Stretches::Stretches(const Scene& scene, const Simulation& simulation, const DiagnosticsOptions& options)
    : simulation_(simulation),
      options_(options),
      duty_(0.8 * options.share),
      begun_(options.clock()),
      parameters_(simulation.parameters),
      frames_(simulation.frames()),
      time_(simulation.time()) {
    for (const GroupPlan& plan : simulation.plan().groups) {
        const Group& group = scene.groups[plan.index];
        std::optional<Warning> why = whyNoReference(scene, group);
        if (why) unknown_.push_back({why->location, concat("group \"", plan.name, "\": ", why->message)});
        groups_.push_back(why ? nullptr : std::make_shared<GroupReference>(scene, group));
        samples_.emplace_back(plan.count, why ? 0 : options.molecules);
    }
}

Stretches::~Stretches() = default;  // waits for the reference that is worked on

void Stretches::open() {
    open_.reset();
    if (unknown_.size() == groups_.size() || !known(simulation_.plan(), simulation_.parameters)) return;
    glFinish();
    const double before = options_.clock();
    auto next = std::make_unique<Open>();
    next->start = simulation_.time();
    for (size_t g = 0; g < groups_.size(); ++g) {
        next->ranges.push_back(samples_[g].next());
        next->molecules.push_back(readSample(simulation_, g, next->ranges.back()));
    }
    open_ = std::move(next);
    const double moment = options_.clock();
    duty_.took(moment - before, moment);
}

// The states at the end, of those that live and are held as at the start.
void Stretches::close() {
    glFinish();
    const double before = options_.clock();
    ended_.clear();
    for (size_t g = 0; g < groups_.size(); ++g) {
        const MoleculeRange& range = open_->ranges[g];
        std::vector<SampledState> ends = readSample(simulation_, g, range);
        for (size_t m = 0; m < ends.size(); ++m) {
            SampledState& start = open_->molecules[g][m];
            if (start.alive && ends[m].alive && start.released == ends[m].released)
                ended_.push_back(
                    {g, range.first + int(m), std::move(start), std::move(ends[m].state), parameters_});
        }
    }
    // of all groups alike, however few there is time for
    const auto place = [&](const Ended& each) { return each.molecule - open_->ranges[each.group].first; };
    std::stable_sort(ended_.begin(), ended_.end(),
                     [&](const Ended& a, const Ended& b) { return place(a) < place(b); });
    open_.reset();
    endedAt_ = options_.clock();
    duty_.took(endedAt_ - before, endedAt_);
}

void Stretches::forget() {
    open_.reset();
    ended_.clear();
    judged_.clear();
    stepped_ = false;
    outdated_ = judging_.valid();
}

bool Stretches::follow() {
    const int frames = std::exchange(frames_, simulation_.frames());
    const double time = std::exchange(time_, simulation_.time());
    const bool others = !(simulation_.parameters == parameters_);
    if (others || frames_ != frames || time_ != time) {
        const bool goesOn = !others && frames_ == frames + 1 && time_ > time;
        if (!goesOn) forget();
        parameters_ = simulation_.parameters;
        stepped_ = goesOn;
    }
    if (open_ && time_ >= open_->start + options_.duration * (1 - 1e-9)) close();
    const double moment = options_.clock();
    if (judging_.valid()) {
        if (judging_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return stepped_;
        take(judging_.get());
    }
    if (!duty_.allows(moment)) return stepped_;
    if (!open_ && (ended_.empty() || moment > endedAt_ + stale)) open();
    if (!ended_.empty()) judging_ = std::async(std::launch::async, nextJudgement());
    return stepped_;
}

// The work of the first that waits; it may be done in another thread.
std::function<Stretches::Judged()> Stretches::nextJudgement() {
    auto ended = std::make_shared<Ended>(std::move(ended_.front()));
    ended_.pop_front();
    // the share of a long run lets a molecule take longer
    const double seconds = std::clamp(options_.share * (options_.clock() - begun_), options_.leastSeconds,
                                      std::max(mostSeconds, options_.leastSeconds));
    return [ended, seconds, group = groups_[ended->group]] {
        const double before = steadySeconds();
        reference::Problem& problem = group->scaledBy(ended->parameters);
        problem.scale = ended->start.scale;
        problem.phase = ended->start.phase;
        problem.held = group->held && !ended->start.released;
        const reference::State& start = ended->start.state;
        Judged out;
        out.group = ended->group;
        out.molecule = ended->molecule;
        out.duration = ended->end.time - start.time;
        const auto errorFrom = [&](const reference::State& exact) {
            return reference::relativeError(ended->end, exact, problem.size());
        };
        const auto tolerance = [&](const reference::State& exact) {
            return std::max(finest, 0.1 * errorFrom(exact));
        };
        const reference::Solution solution =
            reference::solve(problem, start, out.duration, tolerance, 12, seconds);
        const double error = errorFrom(solution.state);
        if (!std::isfinite(errorFrom(start)))
            out.error = std::numeric_limits<double>::infinity();  // it blew up
        else if (solution.error <= tolerance(solution.state))
            out.error = error;
        reference::State end = ended->end;
        end.time = solution.state.time;  // on which the muscles' rest lengths depend
        const double energy = energyGain(problem, start, solution.state, end);
        if (std::isfinite(energy)) out.energy = energy;
        out.seconds = steadySeconds() - before;
        return out;
    };
}

void Stretches::take(Judged judged) {
    duty_.took(judged.seconds, options_.clock());
    if (std::exchange(outdated_, false)) return;
    judged_.push_back(std::move(judged));
    const auto known = std::count_if(groups_.begin(), groups_.end(), [](const auto& each) { return each; });
    while (judged_.size() > size_t(options_.molecules) * size_t(known))
        judged_.pop_front();
}

void Stretches::finish(double seconds) {
    if (judging_.valid()) take(judging_.get());
    if (open_ && ended_.empty() && judged_.empty() && simulation_.time() > open_->start) close();
    const double end = options_.clock() + seconds;
    while (!ended_.empty() && options_.clock() < end)
        take(nextJudgement()());
}

std::string Stretches::nameOf(const Judged& judged) const {
    return concat("molecule ", judged.molecule, " of \"", simulation_.plan().groups[judged.group].name, "\"");
}

void Stretches::tell(Reading& reading) const {
    reading.judged = int(judged_.size());
    reading.noError = unknown_.empty() ? "" : unknown_.front().message;
    double square = 0, given = 0, lost = 0;
    const Judged* worst = nullptr;
    int known = 0;
    for (const Judged& each : judged_) {
        reading.duration = each.duration;
        if (!each.error) continue;
        ++known;
        square += *each.error * *each.error;
        given += std::max(each.energy, 0.0);
        lost += std::max(-each.energy, 0.0);
        if (!worst || *each.error > *worst->error) worst = &each;
    }
    reading.unknown = reading.judged - known;
    if (!worst) return;
    reading[Diagnostic::error] = std::sqrt(square / known);
    reading[Diagnostic::worstError] = *worst->error;
    reading[Diagnostic::energyGiven] = given / known;
    reading[Diagnostic::energyLost] = lost / known;
    for (const Diagnostic quantity : {Diagnostic::error, Diagnostic::worstError})
        reading.places[size_t(quantity)] = nameOf(*worst);
}

}  // namespace shoal::measure
