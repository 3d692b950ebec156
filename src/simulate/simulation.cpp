#include "simulate/simulation.h"

#include <algorithm>
#include <cmath>

#include "core/contract.h"

namespace shoal {

static Tables::Form sampleFormOf(Path path) {
    return path == Path::fused ? Tables::Form::buffer : Tables::Form::texture;
}

Simulation::Simulation(gpu::Context& context, const std::string& shaderRoot, Plan plan,
                       const SimulationOptions& options)
    : context_(&context),
      plan_(std::move(plan)),
      choice_(choosePath(plan_, options.path, limitsOf(context.info()))),
      tables_(context, plan_, sampleFormOf(choice_.path)),
      drawn_(options.drawn),
      inPlace_(options.inPlace),
      timers_(context, options.timing),
      path_(makePath(shaderRoot, options)) {
    if (choice_.path == Path::pingPong && (options.inPlace || options.lanes != Lanes::automatic))
        warnings_.push_back(
            {{}, "one side of the state, and lanes, are of the fused path: they change nothing here"});
    parameters = parametersOf(plan_);
    restart();
}

std::variant<std::monostate, PingPong, Fused> Simulation::makePath(const std::string& shaderRoot,
                                                                   const SimulationOptions& options) {
    using Paths = std::variant<std::monostate, PingPong, Fused>;
    if (choice_.path == Path::pingPong)
        return Paths(std::in_place_type<PingPong>, *context_, shaderRoot, plan_, tables_, options.drawn,
                     options.cache, options.watchdog);
    FusedOptions fused{options.drawn, options.inPlace, options.lanes, options.cache, options.watchdog};
    if (options.path != Path::automatic)
        return Paths(std::in_place_type<Fused>, *context_, shaderRoot, plan_, tables_, fused);
    // Takes what works: two sides, else one, else the other path.
    try {
        return Paths(std::in_place_type<Fused>, *context_, shaderRoot, plan_, tables_, fused);
    } catch (const gpu::OutOfMemory& error) {
        if (options.inPlace) throw;  // the other path takes more
        warnings_.push_back(
            {error.location(), concat(error.message(), "; going on with one side of the state")});
        fused.inPlace = inPlace_ = true;
        return Paths(std::in_place_type<Fused>, *context_, shaderRoot, plan_, tables_, fused);
    } catch (const Error& error) {
        // what the other path does not have
        if (!plan_.contact.onlyOfVertices() || plan_.hasLife() || plan_.school.any()) throw;
        for (const GroupPlan& group : plan_.groups)
            if (solver(group.solver).implicit) throw;
        choice_ = choosePath(plan_, Path::pingPong, limitsOf(context_->info()));
        choice_.why = "the fused path failed";
        tables_ = Tables(*context_, plan_, sampleFormOf(choice_.path));
        warnings_.push_back(
            {error.location(), concat(error.message(), "; going on with the ping-pong path")});
        return Paths(std::in_place_type<PingPong>, *context_, shaderRoot, plan_, tables_, options.drawn,
                     options.cache, options.watchdog);
    }
}

void Simulation::restart() {
    for (size_t g = 0; g < plan_.groups.size(); ++g)
        writeGroup(g, plan_.groups[g].start, 0);
    time_ = lastStep_ = 0;
    lastParameters_.reset();
    frames_ = 0;
    disarm();
    computeNormals();
}

// Computes the normals of a new or loaded state, which may be drawn before a frame.
void Simulation::computeNormals() {
    if (!drawn_) return;
    if (auto* pingPong = std::get_if<PingPong>(&path_)) pingPong->computeNormals(timers_);
    if (auto* fused = std::get_if<Fused>(&path_)) fused->computeNormals(timers_);
}

// Whether a force that comes back to the start of its path, which ends elsewhere, does so between two times.
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

// Whether what acts on molecules is not what went on in the last frame.
bool Simulation::forcesJump() const {
    if (!lastParameters_) return false;
    // forces hold what they are in the middle of a frame (simulate/force_parameters.h)
    const auto middle = [](const Parameters& p) { return (0.5 + 0.5 / p.substeps) * p.frameTime; };
    return jumps(*lastParameters_, parameters) ||
           std::any_of(plan_.forces.begin(), plan_.forces.end(), [&](const Force& force) {
               return comesBack(force, time_ - lastParameters_->frameTime + middle(*lastParameters_),
                                time_ + middle(parameters));
           });
}

void Simulation::frame() {
    EXPECTS(parameters.substeps >= 1);
    check();
    if (forcesJump()) lastStep_ = 0;
    before_ = Moment{time_, lastStep_, frames_};
    const double step = parameters.frameTime / parameters.substeps;
    const Frame frame{time_, time_ + parameters.frameTime, step, frames_, parameters, step != lastStep_};
    lastStep_ = step;
    lastParameters_ = parameters;
    {
        const gpu::TimedFrame timed(timers_);
        if (auto* pingPong = std::get_if<PingPong>(&path_)) pingPong->step(frame, timers_);
        if (auto* fused = std::get_if<Fused>(&path_)) fused->step(frame, timers_);
    }
    time_ = frame.end;
    ++frames_;
}

bool Simulation::alarmed() const {
    if (const auto* fused = std::get_if<Fused>(&path_)) return fused->alarmed();
    return std::get<PingPong>(path_).alarmed();
}

void Simulation::disarm() {
    before_.reset();
    if (auto* fused = std::get_if<Fused>(&path_)) fused->disarm();
    if (auto* pingPong = std::get_if<PingPong>(&path_)) pingPong->disarm();
}

void Simulation::check() const {
    if (!before_ || !alarmed()) return;
    // what was wrong before the last frame is where it began: springs spread it over the molecule
    const std::optional<SavedState> before = saveBefore();
    const Alarm first = before ? findAlarm(*before) : Alarm{};
    throw Runaway(plan_, runsAway(first) ? first : findAlarm(save()));
}

Lanes Simulation::lanes(size_t group) const {
    const auto* fused = std::get_if<Fused>(&path_);
    return fused ? fused->lanes(group) : Lanes::automatic;
}

const ContactResult* Simulation::contact() const {
    if (const auto* fused = std::get_if<Fused>(&path_)) return fused->contact();
    return std::get<PingPong>(path_).contact();
}

LifeCounts Simulation::lifeCounts(size_t group) const {
    return std::get<Fused>(path_).births()->counts(group);
}

bool Simulation::changeLife(size_t group, const Lifecycle& life) {
    auto* fused = std::get_if<Fused>(&path_);
    return fused && plan_.groups[group].needs.life && fused->births()->change(group, life);
}

bool Simulation::changeSprings(size_t group, const Molecule& molecule) {
    auto* fused = std::get_if<Fused>(&path_);
    GroupPlan& plan = plan_.groups[group];
    if (!fused || !plan.needs.liveSprings || fused->lanes(group) != Lanes::molecule) return false;
    if (molecule.springs.size() != size_t(plan.springCount)) return false;
    plan.springNumbers = springNumbers(molecule);
    plan.springFrequencies = springFrequencies(molecule);
    lastStep_ = 0;
    return true;
}

bool Simulation::changeSchool(size_t group, const School& school) {
    auto* fused = std::get_if<Fused>(&path_);
    if (!fused || !fused->school() || !fused->school()->change(group, school)) return false;
    lastStep_ = 0;
    return true;
}

StateView Simulation::state() const {
    if (const auto* fused = std::get_if<Fused>(&path_)) return {nullptr, &fused->state};
    return {&std::get<PingPong>(path_).state, nullptr};
}

size_t Simulation::stateBytes() const {
    return shoal::stateBytes(plan_, choice_.path, drawn_, inPlace_);
}

}  // namespace shoal
