#include "measure/accuracy_reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "compile/surface_pair.h"
#include "core/contract.h"
#include "core/parallel.h"
#include "measure/timing.h"
#include "reference/forces.h"

namespace shoal::measure {

namespace {

constexpr int halvings = 12;

glm::dvec3 centreOfMass(const Molecule& molecule, const reference::State& state) {
    glm::dvec3 out(0);
    for (size_t i = 0; i < state.position.size(); ++i)
        out += molecule.vertices[i].mass * state.position[i];
    return out / molecule.mass();
}

glm::dvec3 ownAngularMomentum(const reference::Problem& problem, const reference::State& state) {
    return reference::angularMomentum(problem, state) -
           glm::cross(centreOfMass(*problem.molecule, state), reference::momentum(problem, state));
}

double ratio(double part, double scale) {
    return scale > 0 ? part / scale : part;
}

}  // namespace

// Names something that acts on the group's molecules and the reference does not know, and where it stands.
static std::optional<std::pair<std::string, Location>> unknownTo(const Scene& scene, const Group& group) {
    if (group.school) return {{"molecules that steer by one another", group.school->location}};
    if (group.life) return {{"births and deaths", group.life->location}};
    for (const Collider& collider : collidersOf(scene, group))
        if (collider.path) return {{"colliders that move", group.location}};
    if (group.contact) return {{"contact between molecules", group.contact->location}};
    return {};
}

std::optional<Warning> whyNoReference(const Scene& scene, const Group& group) {
    const auto unknown = unknownTo(scene, group);
    if (!unknown) return {};
    return Warning{unknown->second,
                   concat("the reference knows no ", unknown->first, ": nothing to measure against")};
}

void requireReference(const Scene& scene) {
    if (scene.groups.empty())
        throw Error(Location{scene.file, 0, 0, {}}, "the scene has no molecules to measure");
    for (const Group& group : scene.groups)
        if (const std::optional<Warning> why = whyNoReference(scene, group))
            throw Error(why->location, why->message);
}

std::string beyondReference(const Scene& scene) {
    for (const Group& group : scene.groups) {
        if (const auto unknown = unknownTo(scene, group)) return unknown->first;
        if (group.release) return "pins that let go";
    }
    return {};
}

reference::Problem springsOf(const Scene& scene, const Group& group, double scale, double phase) {
    reference::Problem out;
    out.molecule = &group.molecule;
    out.scale = scale;
    out.stiffness = group.stiffness;
    out.damping = group.damping;
    out.phase = phase;
    out.held = group.held;
    out.gravity = scene.gravity;
    return out;
}

reference::Problem problemOf(const Scene& scene, const Group& group, double scale, double phase) {
    EXPECTS(!whyNoReference(scene, group));
    reference::Problem out = springsOf(scene, group, scale, phase);
    out.drag = group.drag;
    out.fields = scene.fields;
    out.forces = reference::forcesOn(scene, group);
    out.colliders = collidersOf(scene, group);
    return out;
}

double secondsOfStep(const reference::Problem& problem, const reference::State& start, double duration) {
    const double h = duration / double(reference::firstSteps(problem, duration));
    constexpr int64_t steps = 16;
    const auto run = [&] {
        return secondsOf([&] { reference::integrate(problem, start, h * steps, steps); });
    };
    const double first = run();  // with tables that are made once
    return std::min(first, run()) / steps;
}

static std::vector<std::pair<size_t, int>> firstOf(const std::vector<Snapshot>& starts, int molecules) {
    std::vector<std::pair<size_t, int>> out;
    for (size_t g = 0; g < starts.size(); ++g)
        for (int m = 0; m < std::min(molecules, starts[g].count); ++m)
            out.emplace_back(g, m);
    return out;
}

reference::State ExactEnds::stateOf(const Snapshot& snapshot, int m) {
    const auto first = ptrdiff_t(m) * snapshot.vertexCount, last = first + snapshot.vertexCount;
    return {snapshot.time,
            {snapshot.positions.begin() + first, snapshot.positions.begin() + last},
            {snapshot.velocities.begin() + first, snapshot.velocities.begin() + last}};
}

ExactEnds::ExactEnds(const Scene& scene, const Plan& plan, const std::vector<Snapshot>& starts,
                     double duration, int cores, int molecules)
    : ExactEnds(scene, plan, starts, duration, cores, firstOf(starts, molecules)) {}

ExactEnds::ExactEnds(const Scene& scene, const Plan& plan, const std::vector<Snapshot>& starts,
                     double duration, int cores, const std::vector<std::pair<size_t, int>>& which)
    : scene_(scene), duration_(duration), cores_(std::max(1, cores)) {
    for (const GroupPlan& group : plan.groups)
        groups_.push_back({&scene.groups[group.index], group.name});
    for (const auto& [g, m] : which) {
        const GroupConstants& constants = plan.groups[g].constants;
        ExactMolecule molecule;
        molecule.group = g;
        molecule.index = m;
        molecule.scale = double(constants.scales[size_t(m)]);
        molecule.phase = double(constants.phases[size_t(m)]);
        molecule.start = molecule.end = stateOf(starts[g], m);
        const double size = groups_[g].group->molecule.size() * molecule.scale;
        molecule.size = size > 0 ? size : 1;
        if (groups_[g].steps == 0) {
            const reference::Problem problem = problemOf(molecule);
            groups_[g].steps = double(reference::firstSteps(problem, duration_));
            groups_[g].smooth = problem.colliders.empty();
            secondsPerStep_ = std::max(secondsPerStep_, secondsOfStep(problem, molecule.start, duration_));
        }
        molecules_.push_back(std::move(molecule));
    }
}

reference::Problem ExactEnds::problemOf(const ExactMolecule& molecule) const {
    return measure::problemOf(scene_, *groups_[molecule.group].group, molecule.scale, molecule.phase);
}

// Estimates the seconds of one molecule as most need them: its step is halved six times or, where contact
// breaks the order, as often as is allowed. Then the last halving is left out, because it would not end in
// time.
double ExactEnds::secondsOf(const ExactMolecule& molecule, double most) const {
    const ExactGroup& group = groups_[molecule.group];
    return std::min(group.smooth ? most : most / 2,
                    group.steps * secondsPerStep_ * (group.smooth ? 127 : 8191));
}

double ExactEnds::secondsToSolve(double secondsAMolecule) const {
    double out = 0;
    for (const ExactMolecule& molecule : molecules_)
        out += secondsOf(molecule, secondsAMolecule);
    return out / std::min(cores_, std::max(1, molecules()));
}

double ExactEnds::secondsEach(double seconds, double most) const {
    const int turns = (molecules() + cores_ - 1) / cores_;
    return std::min(most, seconds / std::max(1, turns));
}

std::string ExactEnds::nameOf(const ExactMolecule& molecule) const {
    return concat("molecule ", molecule.index, " of \"", groups_[molecule.group].name, "\"");
}

// Decides beforehand, with a margin for the uncertainty of the estimate. A molecule that passes by mistake is
// ended by the clock.
bool ExactEnds::tooStiff(const ExactMolecule& molecule, double seconds) {
    const double steps = groups_[molecule.group].steps;
    if (3 * steps * secondsPerStep_ < 2 * seconds) return false;
    why_ = concat(nameOf(molecule), " takes ", steps, " steps and more over ", duration_,
                  " s, which is too stiff for a reference in ", seconds, " s");
    return true;
}

Settled ExactEnds::judge(const ExactMolecule& molecule, const reference::Solution& solution, double seconds) {
    using reference::Ended;
    if (solution.converged) return Settled::yes;
    // A slow machine ends early: what still changes much then need not be chaotic.
    if (solution.ended == Ended::outOfTime && !(solution.error <= mostChange)) {
        why_ = concat(nameOf(molecule), " is too stiff for a reference in ", seconds, " s");
        return Settled::tooStiff;
    }
    why_ = concat("the reference of ", nameOf(molecule), " still changes by ", solution.error,
                  " of its size when its step is halved to ", solution.step, " s");
    if (solution.ended == Ended::outOfTime) {
        why_ += concat(", which is as far as ", seconds, " s go");
        return Settled::roughly;
    }
    const bool small = solution.ended == Ended::outOfHalvings && solution.error <= mostChange;
    return small ? Settled::roughly : Settled::chaotic;
}

void ExactEnds::keep(std::vector<reference::Solution>& solutions) {
    double error = 0;
    for (const reference::Solution& solution : solutions)
        error = std::max(error, solution.error);
    if (error >= error_) return;
    error_ = error;
    for (size_t i = 0; i < solutions.size(); ++i)
        molecules_[i].end = std::move(solutions[i].state);
}

Settled ExactEnds::solve(double tolerance, double secondsAMolecule) {
    tolerance = std::max(tolerance, floor);
    if (tolerance >= tolerance_) return Settled::yes;
    for (const ExactMolecule& molecule : molecules_)
        if (tooStiff(molecule, secondsAMolecule)) return Settled::tooStiff;
    std::vector<reference::Solution> solutions(molecules_.size());
    std::atomic<bool> hopeless = false;  // one that is too stiff or chaotic is enough
    parallel(int(molecules_.size()), cores_, [&](int i) {
        if (hopeless) return;
        const ExactMolecule& molecule = molecules_[size_t(i)];
        reference::Solution& solution = solutions[size_t(i)];
        solution = reference::solve(problemOf(molecule), molecule.start, duration_, tolerance, halvings,
                                    secondsAMolecule);
        if (!solution.converged && !(solution.error <= mostChange)) hopeless = true;
    });
    Settled worst = Settled::yes;
    std::string why;
    for (size_t i = 0; i < solutions.size(); ++i) {
        const Settled settled = judge(molecules_[i], solutions[i], secondsAMolecule);
        if (settled <= worst) continue;
        worst = settled;
        why = why_;
    }
    why_ = why;
    if (worst == Settled::yes) tolerance_ = tolerance;
    if (worst <= Settled::roughly) keep(solutions);
    return worst;
}

void ExactEnds::solveEach(const std::vector<size_t>& which, double tolerance, double secondsAMolecule,
                          const TimeLimit& limit) {
    std::mutex guard;  // of why_ and cutShort_
    cutShort_ = false;
    parallel(int(which.size()), cores_, [&](int i) {
        ExactMolecule& molecule = molecules_[which[size_t(i)]];
        const double seconds = std::min(secondsAMolecule, limit.left());
        if (seconds <= 0) {
            const std::lock_guard lock(guard);
            cutShort_ = true;
            return;
        }
        if (3 * groups_[molecule.group].steps * secondsPerStep_ >= 2 * secondsAMolecule) {
            const std::lock_guard lock(guard);
            tooStiff(molecule, secondsAMolecule);
            return;
        }
        reference::Solution solution =
            reference::solve(problemOf(molecule), molecule.start, duration_, tolerance, halvings, seconds);
        if (solution.ended != reference::Ended::outOfTime || seconds == secondsAMolecule) {
            const std::lock_guard lock(guard);
            molecule.chaotic = judge(molecule, solution, seconds) == Settled::chaotic;
        } else {
            const std::lock_guard lock(guard);
            cutShort_ = true;
        }
        if (solution.error >= molecule.bound) return;
        molecule.bound = solution.error;
        molecule.end = std::move(solution.state);
    });
}

bool ExactEnds::finite(const std::vector<Snapshot>& ends) {
    const auto good = [](const glm::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    return std::all_of(ends.begin(), ends.end(), [&](const Snapshot& end) {
        return std::all_of(end.positions.begin(), end.positions.end(), good) &&
               std::all_of(end.velocities.begin(), end.velocities.end(), good);
    });
}

ErrorParts ExactEnds::errorOf(const std::vector<Snapshot>& ends) const {
    ErrorParts out;
    const double count = double(molecules_.size());
    for (const ExactMolecule& molecule : molecules_) {
        const reference::Deviation d =
            reference::deviation(stateOf(ends[molecule.group], molecule.index), molecule.end, molecule.size);
        out.total += d.total * d.total / count;
        out.centroid += d.centroid * d.centroid / count;
        out.shape += d.shape * d.shape / count;
        if (d.total < out.worst) continue;
        out.worst = d.total;
        out.worstGroup = molecule.group;
        out.worstMolecule = molecule.index;
    }
    out.total = std::sqrt(out.total);
    out.centroid = std::sqrt(out.centroid);
    out.shape = std::sqrt(out.shape);
    return out;
}

double ExactEnds::errorOf(size_t molecule, const Snapshot& end) const {
    const ExactMolecule& m = molecules_[molecule];
    return reference::relativeError(stateOf(end, m.index), m.end, m.size);
}

// The E of Drift, J.
static double energyScale(const reference::Problem& p, const reference::State& start,
                          const reference::State& exact) {
    const auto moving = [&](const reference::State& state) {
        return reference::kineticEnergy(p, state) + reference::springEnergy(p, state);
    };
    return std::max({moving(start), moving(exact), p.molecule->mass() * glm::length(p.gravity) * p.size()});
}

double energyGain(const reference::Problem& problem, const reference::State& start,
                  const reference::State& exact, const reference::State& end) {
    return ratio(reference::energy(problem, end) - reference::energy(problem, exact),
                 energyScale(problem, start, exact));
}

Drift ExactEnds::driftOf(const ExactMolecule& molecule, const reference::State& end) const {
    const reference::Problem p = problemOf(molecule);
    const double momentumScale =
        std::sqrt(2 * p.molecule->mass() * energyScale(p, molecule.start, molecule.end));
    return {
        std::abs(energyGain(p, molecule.start, molecule.end, end)),
        ratio(glm::length(reference::momentum(p, end) - reference::momentum(p, molecule.end)), momentumScale),
        ratio(glm::length(ownAngularMomentum(p, end) - ownAngularMomentum(p, molecule.end)),
              momentumScale * molecule.size)};
}

Drift ExactEnds::driftOf(const std::vector<Snapshot>& ends) const {
    Drift out;
    const double count = double(molecules_.size());
    for (const ExactMolecule& molecule : molecules_) {
        // at the reference's own time, on which the muscles' rest lengths depend
        reference::State end = stateOf(ends[molecule.group], molecule.index);
        end.time = molecule.end.time;
        const Drift d = driftOf(molecule, end);
        out.energy += d.energy * d.energy / count;
        out.momentum += d.momentum * d.momentum / count;
        out.angularMomentum += d.angularMomentum * d.angularMomentum / count;
    }
    return {std::sqrt(out.energy), std::sqrt(out.momentum), std::sqrt(out.angularMomentum)};
}

}  // namespace shoal::measure
