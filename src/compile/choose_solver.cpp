#include "compile/choose_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compile/generate_forces.h"
#include "compile/path.h"
#include "compile/strain.h"
#include "molecule/analysis.h"
#include "scene/force_kinds.h"

namespace shoal {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Analysis analyseGroup(const Group& group, const GroupPlan& plan) {
    Molecule scaled = group.molecule;
    for (Spring& spring : scaled.springs) {
        spring.stiffness *= plan.stiffness;
        spring.damping *= plan.damping;
    }
    return analyse(scaled, plan.needs.pins && !plan.needs.release);
}

// Its lowest frequency, rad/s, if it is free and without a soft mode; else 0.
double solidFrequency(const Analysis& analysis) {
    const bool solid = analysis.modesKnown && analysis.rigidModes == 6 && analysis.zeroModes == 0;
    return solid ? analysis.lowestFrequency : 0;
}

std::string steps(double frame, double longest) {
    const double needed = std::ceil(frame / longest);
    return needed <= maxSubsteps
               ? concat("use at least ", needed, " substeps")
               : concat("more than the ", maxSubsteps,
                        " substeps of a frame would do: make the springs softer or the masses larger");
}

void checkStep(const Scene& scene, const Group& group, const GroupPlan& plan) {
    const Location& place = scene.solver.location.empty() ? group.location : scene.solver.location;
    const double frame = 1 / scene.frameRate, step = frame / scene.solver.substeps;
    if (step > plan.stableStep)
        throw Error(place, concat(name(plan.solver), " is stable for \"", plan.name, "\" up to a substep of ",
                                  plan.stableStep, " s (highest frequency ", hertz(plan.highestFrequency),
                                  " Hz); ", scene.solver.substeps, " substeps of a frame are ", step,
                                  " s: ", steps(frame, plan.stableStep),
                                  ", or an implicit solver such as bdf2-xpbd"));
    const double drag = std::max(plan.drag.normal, plan.drag.tangent), most = solver(plan.solver).mostDragged;
    if (drag * step > most)
        throw Error(place, concat(name(plan.solver), " takes drag up to a rate times substep of ", most,
                                  "; \"", plan.name, "\" has ", drag, " /s times ", step,
                                  " s: ", steps(frame, most / drag), ", or another solver"));
}

// How far a group's springs strain with a solver and so many times the scene's substeps (compile/strain.h).
// Where molecules stand in any way, gravity is aslant of all their axes.
double strainOf(const Scene& scene, const Group& group, const GroupPlan& plan, SolverKind kind,
                int finer = 1) {
    StrainRun run{.solver = kind,
                  .substep = 1 / scene.frameRate / scene.solver.substeps,
                  .finer = finer,
                  .scale = group.place.scale.x,
                  .stiffness = plan.stiffness,
                  .damping = plan.damping,
                  .held = plan.needs.pins,
                  .spin = group.spin};
    const bool anyhow =
        group.place.turn == Placement::Turn::any || group.place.align == Placement::Align::normal;
    if (run.held)
        run.gravity = anyhow ? glm::dvec3(glm::length(scene.gravity) / std::sqrt(3.0)) : scene.gravity;
    if (!group.place.items.empty()) {
        const Placement::Item& first = group.place.items.front();
        run.scale = first.scale;
        run.gravity = glm::inverse(first.rotation) * run.gravity;
        run.spin = glm::inverse(first.rotation) * run.spin;
    }
    return largestStrain(group.molecule, run);
}

constexpr double strainTold = 0.02;  // more than in the finest steps
constexpr int finest = 16;           // times the substeps

std::string percent(double share) {
    return concat(std::round(1000 * share) / 10, " %");
}

// Takes bdf2-corotated in place of bdf2-xpbd where sweeps strain the springs and it does not; else warns of
// the solver that strains them.
void checkStrain(const Scene& scene, const Group& group, Plan& plan, GroupPlan& out) {
    if (!solver(out.solver).implicit || !out.needs.springs || !fitsLane(out) || out.isStill()) return;
    const auto strain = [&](SolverKind kind, int finer = 1) {
        return strainOf(scene, group, out, kind, finer);
    };
    const double left = strain(out.solver);
    if (left <= strainTold) return;
    const double most = strain(SolverKind::bdf2Xpbd, finest) + strainTold;
    if (left <= most) return;
    // The solver that holds the springs with so many times the substeps.
    const auto holder = [&](int finer) -> std::optional<SolverKind> {
        if (strain(SolverKind::bdf2Xpbd, finer) <= most) return SolverKind::bdf2Xpbd;
        if (!out.needs.liveSprings && strain(SolverKind::bdf2Corotated, finer) <= most)
            return SolverKind::bdf2Corotated;
        return {};
    };
    int finer = 1;
    std::optional<SolverKind> better = holder(finer);
    while (!better)
        better = holder(finer *= 2);
    if (finer == 1 && !scene.solver.kind) {
        const SolverKind before = std::exchange(out.solver, *better);
        if (!takesLong(plan, out)) {
            out.solverWhy = concat("sweeps would strain the springs by ", percent(left));
            return;
        }
        out.solver = before;
    }
    const double frame = 1 / scene.frameRate;
    const int substeps = scene.solver.substeps;
    std::string instead = finer == 1 ? concat("use ", name(*better)) : steps(frame, frame / substeps / finer);
    if (finer > 1 && scene.solver.kind && *better != out.solver) instead += concat(", with ", name(*better));
    if (finer > 1 && strain(SolverKind::bdf2Newton) <= most)
        instead += concat(", or ", name(SolverKind::bdf2Newton), ", whose steps take long");
    plan.warnings.push_back(
        {scene.solver.location.empty() ? group.location : scene.solver.location,
         concat(name(out.solver), " strains the springs of \"", out.name, "\" by up to ", percent(left),
                ", where bdf2-xpbd in ", finest * substeps, " substeps strains them by ",
                percent(most - strainTold), ": ", instead)});
}

// With a lane a vertex no lane has all vertices of a body that touch a collider together.
void checkBody(const Scene& scene, const Group& group, Plan& plan, const GroupPlan& out) {
    if (!out.rigid || !solver(out.solver).spread || scene.colliders.empty()) return;
    const Location& where = scene.solver.location.empty() ? group.location : scene.solver.location;
    const std::string off = concat("\"", out.name, "\" is a stiff body; ", name(out.solver),
                                   " answers its vertices one by one where it strikes a collider, and its "
                                   "velocity is then off by up to 0.6 of the impact's");
    if (fitsLane(out)) throw Error(where, concat(off, ": use ", name(SolverKind::bdf2Xpbd)));
    plan.warnings.push_back({where, off});
}

// Thrust and wind are taken exactly.
std::optional<size_t> fastestByPlace(const std::vector<Force>& forces, const std::string& group) {
    std::optional<size_t> out;
    for (size_t i = 0; i < forces.size(); ++i) {
        const ForceShape& shape = *forces[i].shape;
        if (std::holds_alternative<ThrustForce>(shape) || std::holds_alternative<WindForce>(shape)) continue;
        if (actsOn(forces[i], group) && (!out || fastestRate(forces[i]) > fastestRate(forces[*out]))) out = i;
    }
    return out;
}

}  // namespace

bool isRigidWithin(const GroupPlan& group, double step) {
    return group.solidFrequency * step > 1 && solver(group.solver).implicit;
}

std::string hastyForce(const std::vector<Force>& forces, const GroupPlan& group, double step) {
    if (!group.fastestForce) return {};
    const Force& force = forces[*group.fastestForce];
    const double rate = fastestRate(force), most = solver(group.solver).mostForced;
    if (rate * step <= most) return {};
    return concat("the force ", force.name.empty() ? "" : concat("\"", force.name, "\" "), "(",
                  kindName(*force.shape), ") turns \"", group.name, "\" by up to ", rate, " rad/s; ",
                  name(group.solver), " is stable up to a frequency times substep of ", most, ", here it is ",
                  rate * step);
}

void chooseSolver(const Scene& scene, const Group& group, Plan& plan, GroupPlan& out) {
    const double step = 1 / scene.frameRate / scene.solver.substeps;
    out.fastestForce = fastestByPlace(scene.forces, group.name);
    const double turning = out.fastestForce ? fastestRate(scene.forces[*out.fastestForce]) : 0;
    Analysis analysis;
    analysis.stableStepEuler = analysis.stableStepLeapfrog = infinite;
    if (out.needs.springs) analysis = analyseGroup(group, out);
    out.highestFrequency = analysis.highestFrequency;

    const bool safe =
        step <= analysis.stableStepLeapfrog && std::hypot(analysis.frequencyBound, turning) * step < 2;
    // `safe` covers springs and forces together; no solver mends a step too long for the forces alone.
    const bool mends = turning * step <= solver(SolverKind::bdf2Xpbd).mostForced;
    if (scene.solver.kind) {
        out.solver = *scene.solver.kind;
        out.solverWhy = "as the scene says";
        const bool matrix = out.factored() || solver(out.solver).spread;
        if (matrix && !out.needs.springs) {
            out.solverWhy = concat(name(out.solver), " without springs is the same");
            out.solver = SolverKind::bdf2Xpbd;
        }
    } else if (!out.needs.springs) {
        out.solver = SolverKind::leapfrog;
        out.solverWhy = "there are no springs";
    } else {
        out.solver = SolverKind::bdf2Xpbd;
        const char* explicitly = safe     ? "the substep resolves the springs"
                                 : !mends ? "no solver resolves the forces with this substep"
                                 : step > analysis.stableStepLeapfrog ? nullptr
                                 : !fitsLane(out)                     ? "the molecule is large"
                                 : takesLong(plan, out)
                                     ? "a CPU rasteriser would take too long to compile bdf2-xpbd"
                                     : nullptr;
        if (explicitly)
            out.solver = SolverKind::leapfrog;
        else if (!fitsLane(out))
            out.solver = SolverKind::bdf2Newton;
        out.solverWhy = concat(explicitly ? explicitly : "the springs are stiff",
                               ": highest frequency times substep ", analysis.highestFrequency * step);
    }
    out.stableStep = solver(out.solver).longestStep(analysis);
    out.solidFrequency = solidFrequency(analysis);
    out.rigid = isRigidWithin(out, step);
    checkStep(scene, group, out);
    checkStrain(scene, group, plan, out);
    checkBody(scene, group, plan, out);
    const std::string hasty = hastyForce(scene.forces, out, step);
    if (hasty.empty()) return;
    const double longest = shoal::solver(out.solver).mostForced / turning;
    plan.warnings.push_back(
        {scene.forces[*out.fastestForce].location, concat(hasty, ": ", steps(1 / scene.frameRate, longest))});
}

}  // namespace shoal
