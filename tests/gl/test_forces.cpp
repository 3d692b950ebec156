// The scene's forces on the GPU, for every solver that the path runs: closed forms, the reference's
// recurrence step for step, orders, and both paths against each other.
#include <cmath>
#include <numbers>

#include "gl/agreement.h"
#include "reference/discrete.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"

using namespace shoal;
using test::at;
using test::run;
using test::setSteps;

namespace {

Force forceOf(ForceShape shape) {
    Force out;
    out.shape = std::move(shape);
    return out;
}

AttractForce star(const glm::dvec3& position, double strength) {
    return {.position = position, .strength = strength, .radius = 0, .most = 1e4};
}

// A leaf that flies among all kinds of forces.
Scene storm(SolverKind kind, std::vector<test::Item> items) {
    Molecule molecule = test::leaf(400, 2);
    molecule.vertices[1].mass = 0.5;
    Scene scene = test::sceneOf(molecule, kind, std::move(items));
    scene.gravity = {0.5, -3, 0};
    scene.groups[0].drag = {2, 0.5};
    scene.groups[0].velocity = {1, 0.5, 0};
    scene.groups[0].spin = {0.5, 2, -1};
    scene.fields.push_back(test::field(test::shear()));
    scene.forces = test::everyForce();
    setSteps(scene, 1 / 60.0, 4);
    return scene;
}

// Where a point ends, and how fast, after a number of frames of so many substeps.
reference::State endOf(Scene scene, SolverKind kind, int substeps, int frames) {
    scene.solver.kind = kind;
    scene.solver.substeps = substeps;
    Simulation simulation = test::simulationOf(scene);
    run(simulation, frames);
    return test::stateOf(simulation.snapshot(0), 0);
}

// On a circle of 2 m around the origin, once round in 1 s.
Scene orbit(SolverKind kind, int substeps) {
    const double omega = 2 * std::numbers::pi, r = 2;
    Scene scene = test::sceneOf(test::point(0.3), kind, {at({r, 0, 0})});
    scene.groups[0].velocity = {0, 0, -omega * r};
    scene.forces.push_back(forceOf(star({0, 0, 0}, omega * omega * r * r * r)));
    setSteps(scene, 1 / 50.0, substeps);
    return scene;
}

}  // namespace

TEST_CASE("every kind of force acts as its closed form says, and what sits at its place stays finite",
          "[forces]") {
    const double h = 1e-3;
    for (const test::KindOfForce& kind : test::kindsOfForce()) {
        if (!kind.known) continue;
        Scene scene =
            test::sceneOf(test::point(0.3), SolverKind::euler, {at(kind.known->x), at(*placeOf(kind.shape))});
        scene.forces.push_back(forceOf(kind.shape));
        setSteps(scene, h, 1);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 1);
        const std::vector<glm::dvec3> velocities = simulation.snapshot(0).velocities;
        INFO(kindName(kind.shape));
        CHECK(glm::length(velocities[0] / h - kind.known->value) < 1e-5 * glm::length(kind.known->value));
        CHECK(glm::length(velocities[1]) < 1e-5);
    }
}

TEST_CASE("a circular orbit comes back after its period, to the solver's order", "[forces]") {
    for (const SolverKind kind : test::solversHere()) {
        if (test::orderOf(kind) < 2) continue;
        double before = 0;
        // rk4 is at float's floor with few steps
        const int coarse = kind == SolverKind::rk4 ? 1 : 2;
        for (const int substeps : {coarse, 2 * coarse}) {
            const reference::State end = endOf(orbit(kind, substeps), kind, substeps, 50);
            const double error = glm::length(end.position[0] - glm::dvec3(2, 0, 0));
            INFO(name(kind) << " " << substeps << " substeps: " << error << " m, before " << before);
            CHECK(error < (kind == SolverKind::rk4 ? 2e-3 : kind == SolverKind::leapfrog ? 0.03 : 0.25));
            if (before > 0) CHECK(std::log2(before / error) > std::min(test::orderOf(kind), 3) - 0.5);
            before = error;
        }
    }
}

TEST_CASE("leapfrog keeps an orbit's energy", "[forces]") {
    Scene scene = orbit(SolverKind::leapfrog, 4);
    scene.groups[0].velocity *= 0.8;  // an ellipse
    const double strength = std::get<AttractForce>(*scene.forces[0].shape).strength;
    Simulation simulation = test::simulationOf(scene);
    const auto energy = [&] {
        const reference::State now = test::stateOf(simulation.snapshot(0), 0);
        return glm::dot(now.velocity[0], now.velocity[0]) / 2 - strength / glm::length(now.position[0]);
    };
    const double start = energy();
    run(simulation, 500);  // ten times 1 s and more rounds
    CHECK(energy() == Approx(start).epsilon(0.01));
}

TEST_CASE("a constant pull within a radius is free fall there, and nothing beyond", "[forces]") {
    AttractForce even{.position = {10, 0, 0}, .strength = 3, .radius = 9};
    even.falloff = AttractForce::Falloff::constant;
    for (const double x : {2.0, -2.0}) {
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({x, 0, 0})});
        scene.forces.push_back(forceOf(even));
        setSteps(scene, 1 / 60.0, 2);
        const reference::State end = endOf(scene, SolverKind::leapfrog, 2, 60);
        CHECK(end.position[0].x == Approx(x > 1 ? x + 1.5 : x).margin(1e-5));
    }
}

TEST_CASE("all solvers follow the reference's recurrence under all forces", "[forces]") {
    for (const SolverKind kind : test::solversHere()) {
        for (const bool pinned : {false, true}) {
            Scene scene = storm(kind, {at({1, 2, 3}, test::turned(), 0.75)});
            scene.groups[0].molecule.vertices[0].pinned = pinned;
            Simulation simulation = test::simulationOf(scene);
            reference::State state = test::stateOf(simulation.snapshot(0), 0);
            const reference::Problem problem = test::problemOf(scene, 0);
            const int frames = solver(kind).history ? 1 : 30;
            for (int i = 0; i < frames; ++i)
                reference::frame(problem, state, kind, 0.5 / frames, 120 / frames);
            run(simulation, 30);
            const reference::State passes = test::stateOf(simulation.snapshot(0), 0);
            INFO(name(kind) << " pinned " << pinned);
            CHECK(reference::relativeError(passes, state, 1) < 1e-5);
            reference::State velocities = passes, expected = state;
            velocities.position = passes.velocity, expected.position = state.velocity;
            CHECK(reference::relativeError(velocities, expected, 1) < 1e-4);
        }
    }
}

TEST_CASE("forces keep each solver's order; thrust takes rk4 to 2", "[forces]") {
    // below the thrust's limit, where everything is smooth; gravity and thrust do not commute
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({1, 2, 3})});
    scene.gravity = {0, -2, 0};
    scene.groups[0].velocity = {1, 1, 0};
    scene.groups[0].drag = {0.5, 0.5};
    scene.forces = {forceOf(star({0, 1, 0}, 9)), forceOf(ThrustForce{1.5, 100}),
                    forceOf(WindForce{{0.5, 0, 1}})};
    setSteps(scene, 1 / 10.0, 1);
    const reference::Problem problem = test::problemOf(scene, 0);
    const reference::State start = restState(problem, {.position = {1, 2, 3}}, {1, 1, 0});
    const reference::State exact = reference::integrate(problem, start, 1, 4000);
    for (const SolverKind kind : test::solversHere()) {
        const int order = std::min(test::orderOf(kind), 2), steps = order == 1 ? 32 : 4;
        const auto error = [&](int substeps) {
            return glm::length(endOf(scene, kind, substeps, 10).position[0] - exact.position[0]);
        };
        const double coarse = error(steps), fine = error(2 * steps);
        INFO(name(kind) << " errors " << coarse << " " << fine);
        CHECK(fine > 1e-5);
        CHECK(std::log2(coarse / fine) == Approx(order).margin(0.3));
    }
}

TEST_CASE("thrust: exponential whatever the step, to its limit and no further", "[forces]") {
    for (const SolverKind kind : test::solversHere()) {
        for (const int substeps : {1, 3, 8}) {
            Scene scene = test::sceneOf(test::point(0.3), kind, {at({1, 2, 3})});
            scene.groups[0].velocity = {0.6, 0, 0.8};
            scene.forces.push_back(forceOf(ThrustForce{1.5, 3}));
            setSteps(scene, 1 / 20.0, substeps);
            INFO(name(kind) << " " << substeps << " substeps");
            const reference::State below = endOf(scene, kind, substeps, 10);
            // verlet's velocity is a difference of positions: 6e-8 m over the substep
            const double rounding = kind == SolverKind::verlet ? 1e-4 : 3e-6;
            CHECK(glm::length(below.velocity[0]) == Approx(std::exp(0.75)).margin(rounding));
            const reference::State end = endOf(scene, kind, substeps, 30);
            CHECK(glm::length(end.velocity[0]) == Approx(3).margin(rounding));
            CHECK(end.velocity[0].x / end.velocity[0].z == Approx(0.75).margin(1e-4));
        }
    }
}

TEST_CASE("a thrust at its limit and one that damps follow the reference's recurrence", "[forces]") {
    for (const SolverKind kind : test::explicitSolvers()) {
        Scene scene = test::sceneOf(test::point(0.3), kind, {at({1, 2, 3})});
        scene.groups[0].velocity = {0, 4, 0};
        scene.forces = {forceOf(ThrustForce{0.8, 4}), forceOf(ThrustForce{-0.2, 1})};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        reference::State state = test::stateOf(simulation.snapshot(0), 0);
        reference::frame(test::problemOf(scene, 0), state, kind, 1 / 6.0, 40);
        run(simulation, 10);
        INFO(name(kind));
        CHECK(simulation.snapshot(0).positions[0].y == Approx(state.position[0].y).margin(1e-5));
    }
}

TEST_CASE("thrust pushes a molecule as a whole: its vibration fades as it does without", "[forces]") {
    Scene scene = test::sceneOf(test::pair(1, 0.5, 80, 0.4), SolverKind::leapfrog, {at({1, 2, 3})});
    scene.groups[0].molecule.vertices[1].position.x = 1.1;
    scene.groups[0].molecule.springs[0].restLength = 1;
    scene.groups[0].velocity = {0.2, 0.1, 0};
    setSteps(scene, 1 / 60.0, 8);
    const auto lengthOf = [](const reference::State& state) {
        return glm::length(state.position[1] - state.position[0]);
    };
    for (const SolverKind kind : test::solversHere()) {
        scene.forces.clear();
        const reference::State without = endOf(scene, kind, 8, 40);
        scene.forces.push_back(forceOf(ThrustForce{3, 2}));
        const reference::State with = endOf(scene, kind, 8, 40);
        INFO(name(kind));
        CHECK(lengthOf(with) == Approx(lengthOf(without)).margin(1e-5));
        const glm::dvec3 mean = (with.velocity[0] + 0.5 * with.velocity[1]) / 1.5;
        CHECK(glm::length(mean) == Approx(std::sqrt(0.05) * std::exp(2)).epsilon(1e-3));
    }
}

TEST_CASE("a vortex line turns by the right-hand rule and pulls to its line", "[forces]") {
    for (const double turn : {2.0, -2.0}) {
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({1, 0.5, 0})});
        scene.forces.push_back(forceOf(
            VortexLineForce{.position = {}, .axis = {0, 1, 0}, .pull = 0.5, .turn = turn, .core = 1}));
        setSteps(scene, 1 / 60.0, 2);
        const reference::State end = endOf(scene, SolverKind::leapfrog, 2, 6);
        const glm::dvec3 spin = glm::cross(end.position[0], end.velocity[0]);
        CHECK(spin.y == Approx(turn * 0.1).epsilon(0.02));
        CHECK(end.velocity[0].x == Approx(-0.05).epsilon(0.05));
        CHECK(end.position[0].y == Approx(0.5));
    }
}

TEST_CASE("a wind among the forces is a uniform field", "[forces]") {
    Scene field = storm(SolverKind::leapfrog, {at({1, 2, 3}, test::turned(), 0.75)});
    field.forces.clear();
    Scene wind = field;
    field.fields.push_back(test::field(UniformField{{0.5, 0, 1}}));
    wind.forces.push_back(forceOf(WindForce{{0.5, 0, 1}}));
    for (const SolverKind kind : test::solversHere()) {
        INFO(name(kind));
        const reference::State a = endOf(field, kind, 4, 30), b = endOf(wind, kind, 4, 30);
        CHECK(reference::relativeError(a, b, 1) < 2e-6);
        wind.fields.clear();  // and where there is no field
        Scene still = field;
        still.fields.erase(still.fields.begin());
        CHECK(reference::relativeError(endOf(still, kind, 4, 30), endOf(wind, kind, 4, 30), 1) < 2e-6);
        wind.fields = {field.fields[0]};
    }
}

TEST_CASE("a force's path is followed, and the hand moves it without a compilation", "[forces]") {
    AttractForce even{.position = {100, 0, 0}, .strength = 3, .radius = 1000};
    even.falloff = AttractForce::Falloff::constant;
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({0, 0, 0})});
    scene.forces.push_back(forceOf(even));
    // the factor from 0 to 2 over a second: middles of frames add up to the integral
    scene.forces[0].path = ForcePath{.keyframes = {{0, {}, 0}, {1, {}, 2}}, .repeats = false};
    setSteps(scene, 1 / 20.0, 2);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 20);
    CHECK(simulation.snapshot(0).velocities[0].x == Approx(3).margin(1e-5));
    simulation.parameters.forces[0].position = glm::dvec3(-100, 0, 0);
    run(simulation, 10);
    CHECK(simulation.snapshot(0).velocities[0].x == Approx(0).margin(2e-2));
    simulation.parameters.forces[0].on = false;
    const double before = simulation.snapshot(0).velocities[0].x;
    run(simulation, 10);
    CHECK(simulation.snapshot(0).velocities[0].x == before);
}

TEST_CASE("the mouse's forces rest until they are told to act; others' groups are left alone", "[forces]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({1, 0, 0})});
    scene.groups.push_back(scene.groups[0]);
    scene.groups[1].name = "others";
    scene.forces.push_back(forceOf(star({0, 0, 0}, 4)));
    scene.forces[0].mouse = true;
    scene.forces[0].groups = {"others"};
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 3);
    CHECK(simulation.snapshot(1).velocities[0] == glm::dvec3(0));
    simulation.parameters.forces[0].on = true;
    run(simulation, 3);
    CHECK(simulation.snapshot(1).velocities[0].x < -0.1);
    CHECK(simulation.snapshot(0).velocities[0] == glm::dvec3(0));
}

TEST_CASE("the two paths agree under forces", "[forces][fused][agreement]") {
    if (!test::canFuse()) return;
    std::vector<test::Item> items;
    for (int i = 0; i < 50; ++i)
        items.push_back(at({i % 7 - 3.5, i / 7 * 0.8, i % 3 - 1.2}, test::turned(), 0.75));
    for (const SolverKind kind : test::explicitSolvers()) {
        Scene scene = storm(kind, items);
        Collider ground;
        ground.name = "ground";
        ground.shape = PlaneCollider{};
        scene.colliders.push_back(ground);
        test::Agreement agreement(scene, {.path = Path::fused}, {.path = Path::pingPong});
        for (const int frame : {0, 30}) {
            const test::Comparison c = agreement.at(frame);
            UNSCOPED_INFO(name(kind) << ", frame " << frame << ": " << text(c));
            CHECK(c.wrong == 0);
            CHECK(c.excepted <= 3);
        }
    }
}

TEST_CASE("what a force presses on a collider rests there", "[forces]") {
    // as gravity would: a pull of 9.81 m/s^2 from far below
    AttractForce below{.position = {0, -1e4, 0}, .strength = 9.81, .radius = 1e5};
    below.falloff = AttractForce::Falloff::constant;
    for (const SolverKind kind : {SolverKind::leapfrog, SolverKind::euler}) {
        Scene scene = test::sceneOf(test::point(1), kind, {at({0, 0.5, 0})});
        scene.forces.push_back(forceOf(below));
        Collider ground;
        ground.shape = PlaneCollider{};
        ground.restitution = 0.5;
        ground.thickness = 0.002;
        scene.colliders.push_back(ground);
        setSteps(scene, 1 / 60.0, 4);
        const reference::State end = endOf(scene, kind, 4, 240);
        INFO(name(kind));
        CHECK(end.position[0].y == Approx(0.002).margin(1e-5));
        CHECK(glm::length(end.velocity[0]) < 1e-5);
    }
}

TEST_CASE("what is born within a frame has flown under the forces since its birth",
          "[forces][fused][birth]") {
    if (!test::canFuse()) return;
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {});
    scene.groups[0].count = 0;
    Lifecycle& life = scene.groups[0].life.emplace();
    life.capacity = 256;
    Emitter& emitter = life.emitters.emplace_back();
    emitter.rate = 517;
    emitter.direction = {1, 0, 0};
    emitter.speed = {1, 1};
    setSteps(scene, 1 / 60.0, 2);
    AttractForce even{.position = {1e4, 0, 0}, .strength = 3, .radius = 1e5};
    even.falloff = AttractForce::Falloff::constant;
    const auto speedsOff = [&](const ForceShape& shape, auto expected) {
        scene.forces = {forceOf(shape)};
        Simulation simulation(testContext(), compile(scene), {.drawn = false, .path = Path::fused});
        run(simulation, 20);
        const GroupState state = simulation.save().groups[0];
        double worst = 0;
        int living = 0;
        for (size_t i = 0; i < state.lives.size(); ++i) {
            if (state.lives[i].y <= 0) continue;
            ++living;
            worst = std::max(worst, std::abs(double(state.velocities[i].x) - expected(state.lives[i].x)));
        }
        CHECK(living > 150);
        return worst;
    };
    CHECK(speedsOff(even, [](double age) { return 1 + 3 * age; }) < 1e-5);
    CHECK(speedsOff(ThrustForce{2, 1.5}, [](double age) { return std::min(std::exp(2 * age), 1.5); }) < 1e-5);
}

TEST_CASE("sliders of forces moved at random lose nothing", "[forces][fuzz]") {
    std::vector<test::Item> items;
    for (int i = 0; i < 40; ++i)
        items.push_back(at({i % 7 - 3.5, i / 7 * 0.8, i % 3 - 1.2}, test::turned(), 0.75));
    Scene scene = storm(SolverKind::leapfrog, items);
    std::get<AttractForce>(*scene.forces[0].shape).most = 50;
    Collider ground;
    ground.shape = PlaneCollider{{0, -5, 0}};
    scene.colliders.push_back(ground);
    Simulation simulation = test::simulationOf(scene);
    uint32_t random = 7;
    const auto next = [&] { return (random = random * 1664525u + 1013904223u) >> 8; };
    for (int i = 0; i < 300; ++i) {
        ForceControl& control = simulation.parameters.forces[next() % scene.forces.size()];
        control.factor = double(next() % 801) / 100 - 4;  // the panel's limits
        control.on = next() % 4 != 0;
        control.position.reset();
        if (next() % 3 == 0) control.position = glm::dvec3(next() % 9, next() % 9, next() % 9) - 4.0;
        simulation.frame();
    }
    simulation.check();
    // thrust of 0.8/s times 4 against drag, pulls of some 200 m/s^2: nothing is out of reach
    for (ForceControl& control : simulation.parameters.forces)
        control = {};
    run(simulation, 120);
    simulation.check();
    const Snapshot now = simulation.snapshot(0);
    CHECK(test::finite(now));
    double furthest = 0;
    for (const glm::dvec3& x : now.positions)
        furthest = std::max(furthest, glm::length(x));
    CHECK(furthest < 1e4);
}
