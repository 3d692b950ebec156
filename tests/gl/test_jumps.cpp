// Solvers with history keep their order across what makes forces jump: there they start anew. Against the
// recurrence in double precision, whose every stretch between two jumps starts without history.
#include <functional>

#include "gl/agreement.h"
#include "gl/numerics.h"
#include "reference/discrete.h"
#include "scene/force_kinds.h"
#include "simulate/checkpoint.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/scratch.h"

namespace shoal {

using test::at;

namespace {

constexpr SolverKind withHistory[] = {SolverKind::bdf2Xpbd, SolverKind::bdf2Corotated};

Simulation fused(const Scene& scene, const CompileOptions& options = {}) {
    return Simulation(testContext(), compile(scene, options), {.drawn = false, .path = Path::fused});
}

}  // namespace

TEST_CASE("what pins have let go falls from rest", "[numerics][fused][jumps]") {
    if (!test::canFuse()) return;
    Molecule point = test::point(1);
    point.vertices[0].pinned = true;
    for (const SolverKind solver : withHistory) {
        Scene scene = test::sceneOf(point, solver);
        scene.gravity = {0, -10, 0};
        scene.groups[0].release = Release{{}, 1e9, 0.1};
        test::setSteps(scene, 0.02, 1);
        Simulation simulation = fused(scene);
        test::run(simulation, 15);  // for 0.2 s of them without pins
        const Snapshot end = simulation.snapshot(0);
        INFO(name(solver) << ", " << end.velocities[0].y << " m/s, " << end.positions[0].y << " m");
        CHECK(end.velocities[0].y == Approx(-2).epsilon(1e-5));
        CHECK(end.positions[0].y == Approx(-0.2).epsilon(1e-5));
    }
}

TEST_CASE("a leaf that pins have let go follows the recurrence from there", "[numerics][fused][jumps]") {
    if (!test::canFuse()) return;
    Molecule leaf = test::leaf(400, 2);
    leaf.vertices[0].pinned = true;
    for (const SolverKind solver : withHistory) {
        Scene scene = test::sceneOf(leaf, solver, {at({1, 2, 3}, test::turned())});
        scene.gravity = {0.5, -9.81, 0};
        scene.fields = {test::field(test::shear())};
        scene.groups[0].drag = {8, 0.5};
        scene.groups[0].release = Release{{}, 1e9, 0.2};
        scene.forces.emplace_back().shape = ThrustForce{2, 3};
        test::setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = fused(scene);
        reference::State state = test::stateOf(simulation.snapshot(0), 0);
        reference::Problem problem = test::problemOf(scene, 0);
        reference::frame(problem, state, solver, 0.2, 48);
        problem.held = false;
        // the matrix is of the leaf with its pins: without them sweeps solve the stage
        reference::frame(problem, state, SolverKind::bdf2Xpbd, 0.3, 72);
        test::run(simulation, 30);
        const double error = reference::relativeError(test::stateOf(simulation.snapshot(0), 0), state, 1);
        INFO(name(solver) << ", off by " << error);
        CHECK(error < 5e-6);
    }
}

TEST_CASE("a slider that jumps starts history anew", "[numerics][fused][jumps]") {
    if (!test::canFuse()) return;
    Molecule leaf = test::leaf(400, 2);
    Scene scene = test::sceneOf(leaf, SolverKind::bdf2Xpbd, {at({1, 2, 3}, test::turned())});
    scene.gravity = {0.5, -9.81, 0};
    scene.fields = {test::field(test::shear())};
    AttractForce pull;
    pull.position = {0, 2, 3};
    pull.strength = 20;
    pull.most = 50;
    scene.forces.emplace_back().shape = pull;
    scene.groups[0].drag = {8, 0.5};
    test::setSteps(scene, 1 / 60.0, 2);
    Simulation simulation = fused(scene, {.liveSprings = true});
    Parameters& now = simulation.parameters;
    Scene then = scene;
    const std::pair<const char*, std::function<void()>> jumps[] = {
        {"nothing", [] {}},
        {"gravity",
         [&] {
             now.gravity = then.gravity = {5, 3, 0};
         }},
        {"wind", [&] { now.wind = 3, then.fields[0].weight = 3; }},
        {"drag",
         [&] {
             now.drag = 3, then.groups[0].drag = {24, 1.5};
         }},
        {"stiffness", [&] { now.stiffness = then.groups[0].stiffness = 0.1; }},
        {"a field", [&] { now.fields = {0.5}, then.fields[0].weight = 1.5; }},
        {"a force", [&] { now.forces[0].on = false, then.forces.clear(); }},
        {"springs",
         [&] {
             for (Spring& spring : then.groups[0].molecule.springs)
                 spring.restLength = 1.2 * leaf.restLength(spring);
             REQUIRE(simulation.changeSprings(0, then.groups[0].molecule));
         }},
    };
    for (const auto& [what, jump] : jumps) {
        jump();
        reference::State state = test::stateOf(simulation.snapshot(0), 0);
        reference::frame(test::problemOf(then, 0), state, SolverKind::bdf2Xpbd, 0.1, 12);
        test::run(simulation, 6);
        const double error = reference::relativeError(test::stateOf(simulation.snapshot(0), 0), state, 1);
        INFO(what << " jumped: off by " << error);
        CHECK(error < 3e-6);
    }
}

TEST_CASE("a state that is saved between a jump and its frame goes on the same",
          "[fused][jumps][checkpoint]") {
    if (!test::canFuse()) return;
    Scene scene = test::sceneOf(test::leaf(400, 2), SolverKind::bdf2Xpbd, {at({1, 2, 3}, test::turned())});
    scene.gravity = {0, -9.81, 0};
    Simulation one = fused(scene), other = fused(scene);
    test::run(one, 5);
    other.load(one.save());  // no jump: it goes on with its history
    test::run(one, 1);
    test::run(other, 1);
    CHECK(one.hash() == other.hash());
    one.parameters.gravity = {3, 5, 0};
    other.parameters = one.parameters;
    other.load(one.save());
    test::run(one, 5);
    test::run(other, 5);
    CHECK(one.hash() == other.hash());
}

TEST_CASE("a force that comes back to the start of its path starts history anew",
          "[numerics][fused][jumps]") {
    if (!test::canFuse()) return;
    Scene scene = test::sceneOf(test::point(1), SolverKind::bdf2Xpbd);
    AttractForce pull;
    pull.position = {0, 1000, 0};
    pull.strength = 1e7;
    pull.most = 50;
    Force& force = scene.forces.emplace_back();
    force.shape = pull;
    // from 10 m/s^2 up to as much down, and at 0.25 s back at once
    ForcePath& path = force.path.emplace();
    path.keyframes = {{0, {}, 1}, {0.25, {}, -1}};
    path.repeats = true;
    test::setSteps(scene, 0.02, 1);
    Simulation simulation = fused(scene);
    test::run(simulation, 12);
    const double before = simulation.snapshot(0).velocities[0].y;
    test::run(simulation, 1);  // its force is that at 0.26 s
    const double gained = simulation.snapshot(0).velocities[0].y - before;
    INFO(gained << " m/s");
    CHECK(gained == Approx(0.02 * 10 * (1 - 2 * 0.01 / 0.25)).epsilon(0.01));
}

TEST_CASE("a checkpoint goes on with its history only under the same forces", "[fused][jumps][checkpoint]") {
    if (!test::canFuse()) return;
    const test::Scratch scratch;
    const std::string file = scratch.path("x.shoal");
    Scene scene = test::sceneOf(test::leaf(400, 2), SolverKind::bdf2Xpbd);
    scene.gravity = {0, -9.81, 0};
    Simulation simulation = fused(scene);
    test::run(simulation, 3);
    writeCheckpoint(file, simulation.plan(), {simulation.save(), simulation.parameters});
    const auto stepIn = [&](const Scene& other) { return readCheckpoint(file, compile(other)).state.step; };
    CHECK(stepIn(scene) == simulation.save().step);
    Scene camera = scene, gravity = scene, field = scene, collider = scene, stiff = scene;
    camera.camera.eye.x += 1;
    gravity.gravity.y = -5;
    field.fields = {test::field(test::shear())};
    field.groups[0].drag = {1, 1};
    collider.colliders.emplace_back().shape = PlaneCollider{};
    stiff.groups[0].stiffness = 2;
    CHECK(stepIn(camera) == simulation.save().step);
    for (const Scene* other : {&gravity, &field, &collider, &stiff})
        CHECK(stepIn(*other) == 0);
}

}  // namespace shoal
