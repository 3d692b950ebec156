#include "compile/choose_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compile/path.h"
#include "molecule/analysis.h"

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

// Free, without a soft mode, and every deformation is over within a step.
bool isRigid(const Analysis& analysis, double step) {
    return analysis.modesKnown && analysis.rigidModes == 6 && analysis.zeroModes == 0 &&
           analysis.lowestFrequency * step > 1;
}

double stableStep(const Analysis& analysis, SolverKind kind) {
    switch (kind) {
    case SolverKind::euler:
    case SolverKind::verlet:
        return analysis.stableStepEuler;
    case SolverKind::leapfrog:
        return analysis.stableStepLeapfrog;
    case SolverKind::rk4:
        return analysis.stableStepRk4;
    default:
        return infinite;
    }
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
                                  plan.stableStep, " s (highest frequency ", plan.highestFrequency,
                                  " rad/s); ", scene.solver.substeps, " substeps of a frame are ", step,
                                  " s: ", steps(frame, plan.stableStep),
                                  ", or an implicit solver such as bdf2-xpbd"));
    const double drag = std::max(plan.drag.normal, plan.drag.tangent), most = solver(plan.solver).mostDragged;
    if (drag * step > most)
        throw Error(place, concat(name(plan.solver), " takes drag up to a rate times substep of ", most,
                                  "; \"", plan.name, "\" has ", drag, " /s times ", step,
                                  " s: ", steps(frame, most / drag), ", or another solver"));
}

}  // namespace

void chooseSolver(const Scene& scene, const Group& group, GroupPlan& out) {
    const double step = 1 / scene.frameRate / scene.solver.substeps;
    Analysis analysis;
    analysis.stableStepEuler = analysis.stableStepLeapfrog = analysis.stableStepRk4 = infinite;
    if (out.needs.springs) analysis = analyseGroup(group, out);
    out.highestFrequency = analysis.highestFrequency;

    const bool safe = step <= analysis.stableStepLeapfrog && analysis.frequencyBound * step < 2;
    if (scene.solver.kind) {
        out.solver = *scene.solver.kind;
        out.solverWhy = "as the scene says";
        if (out.solver == SolverKind::bdf2Corotated && !out.needs.springs) {
            out.solver = SolverKind::bdf2Xpbd;
            out.solverWhy = "bdf2-corotated without springs is the same";
        }
    } else if (!out.needs.springs) {
        out.solver = SolverKind::leapfrog;
        out.solverWhy = "there are no springs";
    } else if (safe || out.vertexCount > FusedLimits::softwareLane ||
               out.springCount > FusedLimits::laneSprings) {
        out.solver = SolverKind::leapfrog;
        out.solverWhy = concat(safe ? "the substep resolves the springs" : "the molecule is large",
                               ": highest frequency times substep ", analysis.highestFrequency * step);
    } else {
        out.solver = SolverKind::bdf2Xpbd;
        out.solverWhy = concat("the springs are stiff: highest frequency times substep ",
                               analysis.highestFrequency * step);
    }
    out.stableStep = stableStep(analysis, out.solver);
    out.rigid = out.needs.collide && isRigid(analysis, step) && shoal::solver(out.solver).implicit;
    checkStep(scene, group, out);
}

}  // namespace shoal
