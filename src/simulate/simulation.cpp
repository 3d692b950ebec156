#include "simulate/simulation.h"

#include <algorithm>
#include <cmath>

#include "compile/pack.h"
#include "core/contract.h"
#include "simulate/fused.h"
#include "simulate/ping_pong.h"
#include "simulate/self_check.h"
#include "simulate/watchdog.h"

namespace shoal {

static Tables::Form tableFormOf(Path path) {
    return path == Path::fused ? Tables::Form::buffer : Tables::Form::texture;
}

Simulation::Simulation(gpu::Context& context, Plan plan, const SimulationOptions& options)
    : context_(&context),
      plan_(std::move(plan)),
      limits_(limitsOf(context.info())),
      choice_(chooseRight(options)),
      tables_(context, plan_, tableFormOf(choice_.path)),
      options_(options),
      timers_(context, options.timing),
      path_(makePath()) {
    if (plan_.contact.settings.rest && choice_.path != Path::fused)
        warnings_.push_back(
            {{}, "molecules come to rest in compute shaders alone: \"rest\" changes nothing here"});
    if (options.inPlace && choice_.path != Path::fused)
        warnings_.push_back({{}, "one side of the state needs compute shaders: it changes nothing here"});
    parameters = parametersOf(plan_);
    restart();
}

// Takes what is demanded, else the first path that computes on this driver what it should.
PathChoice Simulation::chooseRight(const SimulationOptions& options) {
    for (;;) {
        const PathChoice choice = choosePath(plan_, options.path, limits_, options.lanes);
        if (options.path != Path::automatic || options.lanes != Lanes::automatic) return choice;
        // Contact as compute shaders was never found wrong, and a CPU rasteriser compiles it for seconds.
        const bool contact = plan_.contact.any() && choice.path != Path::fused;
        const CheckedPart part = contact ? CheckedPart::contact : CheckedPart::step;
        const std::string why = selfCheck(*context_, choice.path, part);
        if (why.empty()) return choice;
        warnings_.push_back({{}, concat("the execution path ", name(choice.path), " is not taken: ", why)});
        limits_.wrong[size_t(choice.path)] = why;
    }
}

std::unique_ptr<ExecutionPath> Simulation::makePath() {
    const auto make = [&](Fused::Form form) {
        return std::make_unique<Fused>(*context_, plan_, tables_, options_, form);
    };
    const auto fused = [&] { return make(Fused::Form::buffers); };
    const auto fragments = [&] { return make(Fused::Form::textures); };
    if (choice_.path == Path::fragments) return fragments();
    if (choice_.path == Path::pingPong)
        return std::make_unique<PingPong>(*context_, plan_, tables_, options_);
    if (options_.path != Path::automatic || options_.lanes != Lanes::automatic) return fused();
    // Takes what works: two sides, else one, else fragments.
    try {
        return fused();
    } catch (const gpu::OutOfMemory& error) {
        if (options_.inPlace) throw;  // fragments take more
        warnings_.push_back(
            {error.location(), concat(error.message(), "; going on with one side of the state")});
        options_.inPlace = true;
        return fused();
    } catch (const Error& error) {
        try {
            choice_ = choosePath(plan_, Path::fragments, limits_);
        } catch (const Error&) {
            throw error;
        }
        choice_.why = "the compute shaders failed";
        tables_ = Tables(*context_, plan_, tableFormOf(choice_.path));
        warnings_.push_back({error.location(), concat(error.message(), "; going on in fragment shaders")});
        return fragments();
    }
}

void Simulation::restart() {
    for (size_t g = 0; g < plan_.groups.size(); ++g)
        path_->write(g, plan_.groups[g].start, 0);
    path_->remember({});
    goOn(0, 0, 0);
}

// Goes on from the state that has just been written. It may be drawn before a frame.
void Simulation::goOn(double time, int frames, double step) {
    time_ = time;
    frames_ = frames;
    lastStep_ = step;
    issued_.clear();
    path_->disarm();
    path_->computeNormals(timers_);
}

// Whether a force jumps between two times, because its repeating path ends elsewhere than it starts.
static bool comesBack(const Force& force, double from, double to) {
    if (!force.path || !force.path->repeats) return false;
    const auto& frames = force.path->keyframes;
    const auto &first = frames.front(), &last = frames.back();
    if (first.offset == last.offset && first.factor == last.factor) return false;
    const auto round = [&](double time) {
        return std::max(0.0, std::floor((time - first.time) / (last.time - first.time)));
    };
    return round(from) != round(to);
}

// Whether anything that acts on molecules has jumped since the last frame.
bool Simulation::forcesJump() const {
    if (issued_.empty()) return false;
    // forces hold what they are in the middle of a frame (forceParameters)
    const auto middle = [](const Parameters& p) { return (0.5 + 0.5 / p.substeps) * p.frameTime; };
    const Parameters& before = issued_.back().frame.parameters;
    return jumps(before, parameters) ||
           std::any_of(plan_.forces.begin(), plan_.forces.end(), [&](const Force& force) {
               return comesBack(force, time_ - before.frameTime + middle(before), time_ + middle(parameters));
           });
}

void Simulation::frame() {
    EXPECTS(parameters.substeps >= 1);
    context_->checkAlive();
    stopWhereItRanAway(false);
    if (forcesJump()) lastStep_ = 0;
    const double before = lastStep_;
    lastStep_ = parameters.frameTime / parameters.substeps;
    issued_.push_back(
        {{time_, time_ + parameters.frameTime, lastStep_, frames_, parameters, lastStep_ != before}, before});
    if (issued_.size() > RunawayWord::mostBehind + 1) issued_.pop_front();
    const Frame& next = issued_.back().frame;
    {
        const gpu::TimedFrame timed(timers_);
        path_->step(next, timers_);
    }
    time_ = next.end;
    ++frames_;
}

void Simulation::check() {
    stopWhereItRanAway(true);
}

void Simulation::stopWhereItRanAway(bool waits) {
    if (issued_.empty()) return;
    const std::optional<int> since = path_->framesSinceAlarm(waits);
    if (!since) return;
    for (int i = 0; i < *since; ++i) {
        EXPECTS(issued_.size() > 1);
        lastStep_ = issued_.back().stepBefore;
        issued_.pop_back();
        time_ = issued_.back().frame.end;
        --frames_;
    }
    path_->goBack(*since);
    // The state before the last frame shows where the trouble began: springs spread it over the molecule.
    const std::optional<SavedState> before = saveBefore();
    const Alarm first = before ? findAlarm(*before) : Alarm{};
    throw Runaway(plan_, runsAway(first) ? first : findAlarm(save()));
}

bool Simulation::changeSprings(size_t group, const Molecule& molecule) {
    GroupPlan& plan = plan_.groups[group];
    if (!plan.needs.liveSprings || path_->lanes(group) == Lanes::automatic) return false;
    if (molecule.springs.size() != size_t(plan.springCount)) return false;
    const std::vector<double> muscles = muscleFrequencies(molecule);
    if (muscleAngles(muscles, 0).size() != muscleAngles(plan.muscles, 0).size()) return false;
    plan.muscles = muscles;
    plan.springNumbers = springNumbers(molecule);
    plan.springFrequencies = springFrequencies(molecule);
    if (path_->lanes(group) == Lanes::vertex) {
        repackTopology(molecule, group, plan_);
        tables_.updateTopology(plan_, group);
    }
    lastStep_ = 0;
    return true;
}

bool Simulation::changeSchool(size_t group, const School& school) {
    if (!path_->changeSchool(group, school)) return false;
    lastStep_ = 0;
    return true;
}

StateView Simulation::state() const {
    return path_->view();
}

}  // namespace shoal
