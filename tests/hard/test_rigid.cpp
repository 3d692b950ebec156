// Tests rigid motion: nothing may be lost, and nothing may depend on where, which way or how fast.
#include <cmath>

#include "hard/outcome.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

// Largest distance of two states' vertices, in m, once `back` has taken the second's positions to the
// first's.
template <typename Back>
double apart(const reference::State& a, const reference::State& b, Back back) {
    double out = 0;
    for (size_t i = 0; i < a.position.size(); ++i)
        out = std::max(out, glm::length(a.position[i] - back(b.position[i])));
    return out;
}

// A leaf that swings and turns, for 1 s in 480 steps; w h = 0.04 on average, so that rounding is not
// amplified.
reference::State swung(Scene scene) {
    setSteps(scene, 1 / 60.0, 8);
    Simulation simulation = test::hardSimulation(scene);
    test::runChecked(simulation, 60);
    return test::stateOf(simulation.snapshot(0), 0);
}

Scene swinging(const Solver& solver, const test::Item& item) {
    Scene scene = test::sceneOf(test::leaf(100, 0.5), solver.kind, {item});
    scene.groups[0].drag = {1, 1};
    return scene;
}

}  // namespace

// |L| = |sum m x cross v| stays. Every force is along a line between two vertices, so that a method whose
// positions move by the velocity it keeps changes it by roundings only. Implicit ones damp: BDF2's
// amplification at w h is 1 - (w h)^4 / 4, so that spin w loses w^4 h^3 t / 4, 0.9 % at 21 rad/s; a method of
// order 1 loses w^2 h t = 18 of them.
TEST_CASE("hard: a rigid spin", "[hard][rigid]") {
    const auto run = [](const Solver& solver, Judge& judge, const glm::dvec3& spin) {
        Scene scene = test::sceneOf(test::leaf(1e4, 0), solver.kind);
        scene.groups[0].spin = spin;
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        const reference::Problem problem = test::problemOf(scene, 0);
        const reference::State start = test::stateOf(simulation.snapshot(0), 0);
        test::runChecked(simulation, 1200);
        const reference::State end = test::stateOf(simulation.snapshot(0), 0);
        const glm::dvec3 before = angularMomentum(problem, start), after = angularMomentum(problem, end);
        // 1e-5 in float is what 9600 random roundings of 6e-8 leave; 25 % what BDF2 may damp
        judge.atMost("lost", glm::length(after - before) / glm::length(before),
                     solver.implicit ? 0.25 : 1e-5 + test::divided(solver, 9600));
    };
    test::holds("rigid spin, 4 rad/s for 20 s", [&](const Solver& s, Judge& judge) {
        run(s, judge, {2, 1, 3});
    });
    test::holds("rigid spin, 21 rad/s for 20 s", [&](const Solver& s, Judge& judge) {
        run(s, judge, {12, 12.5, -10});
    });
}

TEST_CASE("hard: the rest shape moved rigidly", "[hard][rigid]") {
    const double stiffness = 1e4;
    const glm::dquat half = glm::angleAxis(3.0, glm::normalize(glm::dvec3(-1, 0.2, 0.5)));
    const std::vector<test::Item> items{at({0, 0, 0}), at({3.7, -2.1, 0.4}, test::turned()),
                                        at({-1e3, 55.5, 2e4}, half), at({0.1, 1e5, 0}, test::turned(), 1.5)};
    test::holds("rest shape, moved rigidly", [&](const Solver& solver, Judge& judge) {
        Scene scene = test::sceneOf(test::leaf(stiffness, 1), solver.kind, items);
        const double h = 1 / 60.0 / 8;
        setSteps(scene, h, 1);
        Simulation still = test::hardSimulation(scene);
        test::runChecked(still, 1);
        for (const glm::dvec3& v : still.snapshot(0).velocities)
            judge.atMost("force / kL", glm::length(v) / h / stiffness, 1e-6);  // m = L = 1
        setSteps(scene, 1 / 60.0, 8);
        scene.groups[0].velocity = {3, 1, -2};
        Simulation moving = test::hardSimulation(scene);
        test::runChecked(moving, 300);
        const Snapshot now = moving.snapshot(0);
        for (int m = 0; m < 4; ++m) {
            const double energy = reference::kineticEnergy(test::problemOf(scene, m), test::stateOf(now, m));
            // four masses of 1 at |v|^2 = 14; 2400 roundings of 6e-8, which wander as their root and go on
            // halved
            judge.atMost("energy lost", energy / 28 - 1, 1e-5 + 2 * test::divided(solver, 2400));
        }
    });
}

// The motion is the same in a frame that moves with V: x' = x + V t. |V| of 10 m/s, where a rounding is 5e-7
// m/s: 480 of them, at random over 1 s, are 6e-6 m; relative to V t of 10 m they may be 1e-5.
TEST_CASE("hard: Galilean shift", "[hard][rigid]") {
    test::holds("Galilean shift", [](const Solver& solver, Judge& judge) {
        const glm::dvec3 shift{8, -5, 3.5};
        reference::State states[2];
        for (int i = 0; i < 2; ++i) {
            Scene scene = swinging(solver, at({0, 0, 0}, test::turned()));
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].spin = {1, 2, 0.5};
            scene.groups[0].velocity = double(i) * shift;
            scene.fields = {test::field(UniformField{glm::dvec3(1, 0, 2) + double(i) * shift})};
            states[i] = swung(scene);
        }
        judge.atMost("apart / Vt",
                     apart(states[0], states[1], [&](const glm::dvec3& x) { return x - shift; }) / 10, 1e-5);
    });
}

// The motion is the same in a world turned by R: x' = R x. Start, spin, gravity and wind turn as well.
TEST_CASE("hard: rotated world", "[hard][rigid]") {
    test::holds("rotated world", [](const Solver& solver, Judge& judge) {
        const glm::dquat turn = glm::angleAxis(1.1, glm::normalize(glm::dvec3(2, -1, 0.5)));
        reference::State states[2];
        for (int i = 0; i < 2; ++i) {
            const glm::dquat r = i == 0 ? glm::dquat(1, 0, 0, 0) : turn;
            Scene scene = swinging(solver, at({0, 0, 0}, r * test::turned()));
            scene.gravity = r * glm::dvec3(0, -9.81, 0);
            scene.groups[0].spin = r * glm::dvec3(1, 2, 0.5);
            scene.groups[0].velocity = r * glm::dvec3(1, 0, 0);
            scene.fields = {test::field(UniformField{r * glm::dvec3(1, 0, 2)})};
            states[i] = swung(scene);
        }
        // 480 roundings of 6e-8 m and 5e-7 m/s, relative to the way of 4 m that it falls
        const auto back = [&](const glm::dvec3& x) { return glm::inverse(turn) * x; };
        judge.atMost("apart / way", apart(states[0], states[1], back) / 4, 1e-5);
    });
}

// Positions are kept relative to an anchor: the error against the reference is that at the origin, at most
// twice it, or a micrometre where both are roundings.
TEST_CASE("hard: 100 km from the origin", "[hard][rigid]") {
    test::holds("100 km from the origin", [](const Solver& solver, Judge& judge) {
        double errors[2];
        for (int i = 0; i < 2; ++i) {
            const glm::dvec3 origin = double(i) * glm::dvec3(1e5, -1e5, 1e5 + 0.0625);
            Scene scene = swinging(solver, at(origin, test::turned()));
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].spin = {1, 2, 0.5};
            ShearField shear = test::shear();
            shear.origin = origin;
            scene.fields = {test::field(shear)};
            const reference::State end = swung(scene);
            const reference::State start = test::stateOf(test::hardSimulation(scene).snapshot(0), 0);
            const auto solution = reference::solve(test::problemOf(scene, 0), start, 1, 1e-7);
            errors[i] = reference::relativeError(end, solution.state, 1);
        }
        judge.report("error at the origin", errors[0]);
        judge.atMost("error there", errors[1], 2 * errors[0] + 1e-6);
    });
}

TEST_CASE("hard: pinned vertices", "[hard][rigid]") {
    test::holds("pinned vertices keep their bits", [](const Solver& solver, Judge& judge) {
        Molecule molecule = test::leaf(300, 1);
        molecule.vertices[0].pinned = molecule.vertices[1].pinned = true;
        Scene scene = test::sceneOf(molecule, solver.kind,
                                    {at({5.123, 7.7, -3.1}, test::turned()), at({-1, 0, 80.03})});
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].drag = {9, 3};
        scene.groups[0].velocity = {2, 0, 0};
        scene.fields.push_back(test::field(GustField{}));
        PlaneCollider ground;
        ground.point = {0, 7.6, 0};
        scene.colliders.push_back({});
        scene.colliders[0].shape = ground;
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        const Snapshot start = simulation.snapshot(0);
        test::runChecked(simulation, 300);
        const Snapshot end = simulation.snapshot(0);
        judge.finite(end);
        double free =
            1;  // how far the least of the others went: a scene in which nothing moves proves nothing
        for (size_t i = 0; i < 8; ++i) {
            const double moved = glm::length(end.positions[i] - start.positions[i]);
            if (i % 4 < 2) {
                judge.atMost("pins moved m", moved, 0);
                judge.atMost("pins' m/s", glm::length(end.velocities[i]), 0);
            } else {
                free = std::min(free, moved);
            }
        }
        judge.near("others moved m", free, 1, 0.999);
    });
}

}  // namespace shoal
