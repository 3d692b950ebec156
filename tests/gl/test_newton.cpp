// bdf2-newton: large stiff molecules, springs that carry a load through many others, and what its lanes may
// not depend on.
#include <numbers>

#include "gl/births.h"
#include "gl/feature_scenes.h"
#include "molecule/analysis.h"
#include "reference/discrete.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

bool canSpread() {
    return runsHere(solver(SolverKind::bdf2Newton));
}

Simulation fused(const Plan& plan, SimulationOptions options = {}) {
    options.path = Path::fused;
    options.drawn = false;
    return Simulation(testContext(), plan, options);
}

// A sheet held by a corner, without muscles, whose highest frequency times substep is `product`.
Scene hangingSheet(int columns, int rows, double product, int substeps) {
    Molecule molecule = sheet(columns, rows, true);
    for (Spring& spring : molecule.springs)
        spring.actuation.reset();
    Scene scene = sceneOf(molecule, SolverKind::bdf2Newton, {at({1, 2, 3}, turned())});
    setSteps(scene, 1 / 60.0, substeps);
    scene.gravity = {0, -9.81, 0};
    const double h = 1 / 60.0 / substeps, w = analyse(molecule, true).highestFrequency;
    const double factor = product / (w * h);
    scene.groups[0].stiffness = factor * factor;
    scene.groups[0].damping = factor;  // of the same share of the critical
    return scene;
}

double strainAfter(const Scene& scene, int frames) {
    Simulation simulation = fused(compile(scene));
    run(simulation, frames);
    const Snapshot end = simulation.snapshot(0);
    CHECK(finite(end));
    return worstStrain(scene.groups[0].molecule, stateOf(end, 0));
}

}  // namespace

TEST_CASE("bdf2-newton is the same steps in double precision, of a sheet of 72 vertices",
          "[newton][numerics]") {
    if (!canSpread()) return;
    for (const double product : {30.0, 1000.0}) {
        const Scene scene = hangingSheet(9, 8, product, 2);
        Simulation simulation = fused(compile(scene));
        reference::State state = stateOf(simulation.snapshot(0), 0);
        reference::frame(problemOf(scene, 0), state, SolverKind::bdf2Newton, 0.25, 30);
        run(simulation, 15);
        INFO(product);
        CHECK(reference::relativeError(stateOf(simulation.snapshot(0), 0), state, 1) < 1e-4);
    }
}

// Largest at the corner, from which all hangs.
TEST_CASE("bdf2-newton strains a falling sheet of stiff vertices by its weight", "[newton][numerics]") {
    if (!canSpread()) return;
    CHECK(strainAfter(hangingSheet(9, 8, 30, 1), 60) < 0.02);
    CHECK(strainAfter(hangingSheet(15, 14, 1000, 1), 6) < 1e-3);  // 210 of them
}

TEST_CASE("bdf2-newton strains a chain that swings by its load", "[newton][numerics]") {
    if (!canSpread()) return;
    Scene scene = sceneOf(hangingChain(20, 1e5, 20), SolverKind::bdf2Newton);
    scene.gravity = {100 * std::sin(0.3), -100 * std::cos(0.3), 0};
    CHECK(strainAfter(scene, 30) == Approx(0.0021).margin(3e-4));
}

TEST_CASE("bdf2-newton strains overdamped springs in spin as the reference does", "[newton][numerics]") {
    if (!canSpread()) return;
    for (const double damping : {10.0, 100.0, 1e3, 2e3, 1e4}) {
        Scene scene = sceneOf(regularTetrahedron(100, damping), SolverKind::bdf2Newton);
        scene.gravity = {0, 0, 0};
        scene.groups[0].spin = {5, 3, 20};
        const reference::State exact = reference::integrate(
            problemOf(scene, 0), reference::restState(problemOf(scene, 0), {}, {}, {5, 3, 20}), 0.5,
            20000 + int64_t(200 * damping));
        INFO(damping);
        CHECK(strainAfter(scene, 30) == Approx(worstStrain(scene.groups[0].molecule, exact)).margin(1.5e-3));
    }
}

// Whose Newton steps go on for as long as one of them moves.
TEST_CASE("with bdf2-newton a molecule does not depend on those beside it, on parts or on the run",
          "[newton][fused]") {
    if (!canSpread() || !keepsBits()) return;
    Scene scene = swarm(sheet(5, 3, true), 67, SolverKind::bdf2Newton);
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = 2;
    scene.groups[0].stiffness = 1e4;
    scene.groups[0].spin = {3, 2, 1};
    const Plan plan = compile(scene);
    Simulation all = fused(plan), again = fused(plan), parts = fused(plan, {.largestPart = 16}),
               inPlace = fused(plan, {.inPlace = true});
    for (Simulation* one : {&all, &again, &parts, &inPlace})
        run(*one, 10);
    CHECK(again.hash() == all.hash());
    CHECK(parts.hash() == all.hash());
    CHECK(inPlace.hash() == all.hash());
    Simulation kicked = fused(plan);
    SavedState state = kicked.save();
    for (size_t i = 15; i < state.groups[0].velocities.size(); ++i)
        state.groups[0].velocities[i] += glm::vec3(float(i % 7), 5, 0);
    kicked.load(state);
    run(kicked, 10);
    const Snapshot one = all.snapshot(0), other = kicked.snapshot(0);
    CHECK(std::equal(one.positions.begin(), one.positions.begin() + 15, other.positions.begin()));
    CHECK(one.positions[16] != other.positions[16]);
}

TEST_CASE("with bdf2-newton pins are released and molecules are born", "[newton][fused]") {
    if (!canSpread()) return;
    Molecule molecule = sheet(5, 3, true);
    addMuscles(molecule, 0.1);
    Scene scene = swarm(molecule, 40, SolverKind::bdf2Newton, {0, 1.2, 0});
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {everyCollider()[0]};
    scene.solver.substeps = 4;
    Group& group = scene.groups[0];
    group.drag = {3, 0.8};
    group.stiffness = 100;
    group.release = Release{20, 4, 0};
    group.phaseSpread = 3;
    Scene fine = scene;
    fine.solver.kind = SolverKind::leapfrog;
    setStableSubsteps(fine);
    Simulation newton = fused(compile(scene)), explicitly = fused(compile(fine));
    run(newton, 20);
    run(explicitly, 20);
    CHECK(finite(newton.snapshot(0)));
    const auto released = [](const Simulation& simulation) {
        const auto pins = simulation.save().groups[0].released;
        return std::count(pins.begin(), pins.end(), true);
    };
    CHECK(released(newton) > 5);
    CHECK(std::abs(double(released(newton) - released(explicitly))) <= 5);

    Emitter emitter = steady(600);
    emitter.speed = {2, 8};
    Scene births = emitting(emitter, 150, {0.1, 0.4});
    births.solver.kind = SolverKind::bdf2Newton;
    births.groups[0].molecule = sheet(4, 2, false);
    births.groups[0].stiffness = 100;
    Simulation living = fused(compile(births));
    run(living, 40);
    CHECK(finite(living.snapshot(0)));
    const LifeCounts counts = living.lifeCounts(0);
    CHECK(counts.born > uint64_t(counts.live) + 50);
}
