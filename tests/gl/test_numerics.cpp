// The passes against closed forms (NUMERICS: the hard cases). Tolerances state what float leaves: positions
// are kept within 1 m of an anchor, so that one rounding is 6e-8 m at most.
#include <cmath>

#include "gl/numerics.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"

namespace shoal {

using test::at;
using test::bothSolvers;
using test::run;
using test::setSteps;

namespace {

// Two masses on a spring, stretched by 10 % at the start: `at` and rest differ through an explicit rest
// length.
Molecule stretchedPair(double stiffness, double damping) {
    Molecule out = test::pair(1, 0.5, stiffness, damping);
    out.vertices[1].position.x = 1.1;
    out.springs[0].restLength = 1;
    return out;
}

// RMS over 30 frames in 1 s of the spring's length against x(t) = 1 + 0.1 e^-dt (cos wt + d/w sin wt).
double pathError(SolverKind kind, double stiffness, double damping, int substeps) {
    Scene scene = test::sceneOf(stretchedPair(stiffness, damping), kind);
    setSteps(scene, 1 / 30.0, substeps);
    Simulation simulation = test::simulationOf(scene);
    const double reduced = 1 * 0.5 / 1.5, decay = damping / (2 * reduced);
    const double omega = std::sqrt(stiffness / reduced - decay * decay);
    double sum = 0;
    for (int i = 1; i <= 30; ++i) {
        simulation.frame();
        const Snapshot now = simulation.snapshot(0);
        const double t = now.time, length = now.positions[1].x - now.positions[0].x;
        const double expected =
            1 + 0.1 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
        sum += (length - expected) * (length - expected) / 30;
    }
    return std::sqrt(sum);
}

}  // namespace

TEST_CASE("two masses on a spring: the error falls with the order", "[numerics]") {
    for (SolverKind kind : bothSolvers) {
        for (double damping : {0.0, 0.5}) {
            const int steps = kind == SolverKind::euler ? 64 : 8;
            const double coarse = pathError(kind, 80, damping, steps),
                         fine = pathError(kind, 80, damping, 2 * steps);
            INFO(name(kind) << " c " << damping << " errors " << coarse << " " << fine);
            CHECK(fine > 2e-6);  // well above float's floor, or the slope means nothing
            CHECK(std::log2(coarse / fine) == Approx(test::orderOf(kind)).margin(0.15));
        }
    }
}

TEST_CASE("the passes follow the exact discrete recurrence to rounding", "[numerics]") {
    Molecule molecule = test::leaf(400, 2);
    molecule.springs[5].actuation = Actuation{0.2, 3, 0.7};
    for (SolverKind kind : test::solversHere()) {
        for (const Drag drag : {Drag{0, 0}, Drag{1.5, 1.5}, Drag{8, 0.5}, Drag{9000, 6000}}) {
            if (drag.normal / 240 > solver(kind).mostDragged) continue;
            for (bool pinned : {false, true}) {
                molecule.vertices[0].pinned = pinned;
                Scene scene = test::sceneOf(molecule, kind, {at({1, 2, 3}, test::turned(), 0.75)});
                scene.gravity = {0.5, -9.81, 0};
                Group& group = scene.groups[0];
                group.drag = drag;
                group.stiffness = 1.5, group.damping = 0.5, group.phaseSpread = 2;
                group.velocity = {1, 0, 0};
                group.spin = {0.5, 2, -1};
                scene.fields.push_back(test::field(test::shear()));
                scene.fields.back().weight = 0.5;
                setSteps(scene, 1 / 60.0, 4);
                Simulation simulation = test::simulationOf(scene);
                reference::State state = test::stateOf(simulation.snapshot(0), 0);
                const reference::Problem problem = test::problemOf(scene, 0);
                // what has history goes on with it; what has none starts every frame anew
                const int frames = solver(kind).history ? 1 : 30;
                for (int i = 0; i < frames; ++i)
                    reference::frame(problem, state, kind, 0.5 / frames, 120 / frames);
                run(simulation, 30);
                const reference::State passes = test::stateOf(simulation.snapshot(0), 0);
                INFO(name(kind) << " drag " << drag.normal << ", " << drag.tangent << " pinned " << pinned);
                CHECK(reference::relativeError(passes, state, 1) < 5e-6);
                reference::State velocities = passes, expected = state;
                velocities.position = passes.velocity, expected.position = state.velocity;
                CHECK(reference::relativeError(velocities, expected, 1) < 1e-4);
            }
        }
    }
}

TEST_CASE("free fall: leapfrog exact, euler late by g h t / 2", "[numerics]") {
    const glm::dvec3 start{0.3, 5, -2}, velocity{1, 4, 2}, gravity{0, -9.81, 0};
    const double h = 1 / 240.0;
    for (SolverKind kind : bothSolvers) {
        Scene scene = test::sceneOf(test::point(0.3), kind, {at(start)});
        scene.gravity = gravity;
        scene.groups[0].velocity = velocity;
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        const glm::dvec3 placed = simulation.snapshot(0).positions[0];
        run(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        const double t = now.time;
        REQUIRE(t == Approx(2));
        const glm::dvec3 offset = now.positions[0] - (placed + velocity * t + 0.5 * gravity * t * t);
        const glm::dvec3 expected = kind == SolverKind::euler ? 0.5 * gravity * h * t : glm::dvec3(0);
        INFO(name(kind) << " offset " << offset.y << " expected " << expected.y);
        // 480 velocity roundings of 5e-7 m/s at 16 m/s, if they all went one way for 1 s on average: 2e-4
        CHECK(glm::length(offset - expected) < 1e-4);
        CHECK(glm::length(now.velocities[0] - (velocity + gravity * t)) < 1e-4);
    }
}

TEST_CASE("terminal velocity is u + g / gamma whatever gamma h", "[numerics]") {
    const glm::dvec3 wind{2, 0.5, -1}, gravity{0, -9.81, 0};
    const double h = 1 / 240.0;
    for (SolverKind kind : bothSolvers) {
        Scene scene = test::sceneOf(test::point(1), kind);
        scene.gravity = gravity;
        scene.fields.push_back(test::field(UniformField{wind}));
        scene.groups[0].drag = {240, 240};  // gamma h = 1, times the factor below
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        for (double product = 1e-3; product < 2e5; product *= 10) {
            simulation.restart();
            simulation.parameters.drag = product;
            simulation.parameters.substeps = 1000;
            simulation.parameters.frameTime = 1000 * h;
            const glm::dvec3 terminal = wind + gravity / (240 * product);
            // from rest, until e^-18 of the difference is left
            run(simulation, std::max(1, int(std::ceil(18 / (1000 * product)))));
            const glm::dvec3 off = simulation.snapshot(0).velocities[0] - terminal;
            // a velocity stops when its change in a step is less than half a rounding step: 6e-8 v / (gamma
            // h)
            const double tolerance = (1e-5 + 6e-8 / product) * glm::length(terminal);
            INFO(name(kind) << " gamma h " << product << " off " << glm::length(off) / glm::length(terminal));
            CHECK(glm::length(off) < tolerance);
        }
    }
}

TEST_CASE("a rigid spin keeps its angular momentum for 20 s", "[numerics]") {
    Scene scene = test::sceneOf(test::leaf(1e4, 0), SolverKind::leapfrog);
    scene.groups[0].spin = {2, 1, 3};
    setSteps(scene, 1 / 60.0, 8);
    Simulation simulation = test::simulationOf(scene);
    const reference::Problem problem = test::problemOf(scene, 0);
    const reference::State start = test::stateOf(simulation.snapshot(0), 0);
    run(simulation, 1200);
    const reference::State end = test::stateOf(simulation.snapshot(0), 0);
    const glm::dvec3 before = angularMomentum(problem, start), after = angularMomentum(problem, end);
    INFO("lost " << 1 - glm::length(after) / glm::length(before));
    CHECK(glm::length(after - before) < 1e-5 * glm::length(before));
    CHECK(reference::energy(problem, end) == Approx(reference::energy(problem, start)).epsilon(1e-3));
}

TEST_CASE("the rest shape moved rigidly feels no force and loses no energy", "[numerics]") {
    const double stiffness = 1e4;
    const glm::dquat half = glm::angleAxis(3.0, glm::normalize(glm::dvec3(-1, 0.2, 0.5)));
    const std::vector<test::Item> items{at({0, 0, 0}), at({3.7, -2.1, 0.4}, test::turned()),
                                        at({-1e3, 55.5, 2e4}, half), at({0.1, 1e5, 0}, test::turned(), 1.5)};
    for (SolverKind kind : bothSolvers) {
        Scene scene = test::sceneOf(test::leaf(stiffness, 1), kind, items);
        const double h = 1 / 60.0 / 8;
        setSteps(scene, h, 1);
        Simulation still = test::simulationOf(scene);
        run(still, 1);
        for (const glm::dvec3& v : still.snapshot(0).velocities) {
            CHECK(glm::length(v) / h < 1e-6 * stiffness);  // k L / m, with m = L = 1
        }
        setSteps(scene, 1 / 60.0, 8);
        scene.groups[0].velocity = {3, 1, -2};
        Simulation moving = test::simulationOf(scene);
        run(moving, 300);
        const Snapshot now = moving.snapshot(0);
        for (int m = 0; m < 4; ++m) {
            const reference::State state = test::stateOf(now, m);
            CHECK(reference::kineticEnergy(test::problemOf(scene, m), state) == Approx(4 * 7).epsilon(1e-5));
        }
    }
}

TEST_CASE("pinned vertices are bit-identical for ever", "[numerics]") {
    Molecule molecule = test::leaf(300, 1);
    molecule.vertices[0].pinned = molecule.vertices[1].pinned = true;
    for (SolverKind kind : bothSolvers) {
        Scene scene =
            test::sceneOf(molecule, kind, {at({5.123, 7.7, -3.1}, test::turned()), at({-1, 0, 80.03})});
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].drag = {9, 3};
        scene.groups[0].velocity = {2, 0, 0};
        scene.fields.push_back(test::field(GustField{}));
        PlaneCollider ground;
        ground.point = {0, 7.6, 0};
        scene.colliders.push_back({});
        scene.colliders[0].shape = ground;
        Simulation simulation = test::simulationOf(scene);
        const Snapshot start = simulation.snapshot(0);
        run(simulation, 300);
        const Snapshot end = simulation.snapshot(0);
        for (size_t i = 0; i < 8; ++i) {
            if (i % 4 < 2) {
                CHECK(end.positions[i] == start.positions[i]);
                CHECK(end.velocities[i] == glm::dvec3(0));
            } else {
                CHECK(end.positions[i] != start.positions[i]);
            }
        }
    }
}

TEST_CASE("coincident, collinear and degenerate molecules stay finite with unit normals", "[numerics]") {
    for (SolverKind kind : bothSolvers) {
        for (int shape = 0; shape < 3; ++shape) {
            Molecule molecule = test::leaf(1e3, 1);
            for (Spring& spring : molecule.springs)
                spring.restLength = molecule.restLength(spring);
            for (int i = 0; i < 4; ++i) {
                if (shape == 0) molecule.vertices[size_t(i)].position = {0, 0, 0};
                if (shape == 1) molecule.vertices[size_t(i)].position = {0.3 * i, 0, 0};
            }
            if (shape == 2) molecule.vertices[2].position = molecule.vertices[1].position;
            Scene scene = test::sceneOf(molecule, kind, {at({1, 1, 1}, test::turned())});
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].drag = {8, 1};
            setSteps(scene, 1 / 60.0, 16);
            Simulation simulation = test::simulationOf(scene, true);
            for (int i = 0; i < 60; ++i) {
                simulation.frame();
                const Snapshot now = simulation.snapshot(0);
                INFO(name(kind) << " shape " << shape << " frame " << i);
                REQUIRE(test::finite(now));
                for (const glm::vec3& n : now.normals)
                    REQUIRE(glm::length(n) == Approx(1).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("a molecule 100 km out moves as one at the origin", "[numerics]") {
    const glm::dvec3 far{1e5, -1e5, 1e5 + 0.0625};
    for (SolverKind kind : bothSolvers) {
        reference::State states[2];
        double errors[2];
        for (int i = 0; i < 2; ++i) {
            const glm::dvec3 origin = i == 0 ? glm::dvec3(0) : far;
            Scene scene = test::sceneOf(test::leaf(100, 0.5), kind, {at(origin, test::turned())});
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].drag = {1, 1};
            scene.groups[0].spin = {1, 2, 0.5};
            ShearField shear = test::shear();
            shear.origin = origin;
            scene.fields.push_back(test::field(shear));
            setSteps(scene, 1 / 60.0, 8);
            Simulation simulation = test::simulationOf(scene);
            const auto solution = reference::solve(test::problemOf(scene, 0),
                                                   test::stateOf(simulation.snapshot(0), 0), 1, 1e-7);
            REQUIRE(solution.converged);
            run(simulation, 60);
            states[i] = test::stateOf(simulation.snapshot(0), 0);
            errors[i] = reference::relativeError(states[i], solution.state, 1);
            for (glm::dvec3& x : states[i].position)
                x -= origin;
        }
        INFO(name(kind) << " errors " << errors[0] << " " << errors[1]);
        CHECK(errors[1] == Approx(errors[0]).epsilon(0.01).margin(1e-6));
        CHECK(reference::relativeError(states[0], states[1], 1) < 1e-6);
    }
}

}  // namespace shoal
