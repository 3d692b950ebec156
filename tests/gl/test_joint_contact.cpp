// Contact with thin, moving and several colliders against closed forms (shaders/step/joint_contact.glsl).
// What every solver makes of it is in tests/hard/test_colliders.cpp.
#include <cmath>

#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/colliders.h"
#include "support/message_of.h"

namespace shoal {

using test::at;
using test::collider;
using test::run;
using test::setSteps;

namespace {

BoxCollider box(const glm::dvec3& low, const glm::dvec3& high) {
    BoxCollider out;
    out.center = 0.5 * (low + high);
    out.size = high - low;
    return out;
}

// At a constant velocity, for 9 s.
ColliderPath ride(const glm::dvec3& velocity) {
    ColliderPath out;
    out.keyframes = {{0, {}}, {9, {9.0 * velocity, {1, 0, 0, 0}}}};
    return out;
}

// A quad that drops onto a ball, or several in one place, and rests there, with so many balls far away.
Simulation amongMany(int far, int near = 1) {
    Scene scene = test::swarm(test::shippedMolecule("quad"), 1, SolverKind::euler);
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = 64;
    scene.groups[0].place.box = {{0, 0.3, 0}, {0, 0.3, 0}};
    scene.groups[0].place.turn = Placement::Turn::none;
    for (int i = 0; i < far; ++i)
        scene.colliders.push_back(
            {.name = concat("far ", i), .shape = SphereCollider{{50 + 3 * i, 0, 0}, 1}});
    for (int i = 0; i < near; ++i)
        scene.colliders.push_back({.name = concat("near ", i), .shape = SphereCollider{{0, -1, 0}, 1}});
    return Simulation(testContext(), compile(scene), {.path = testPath()});
}

}  // namespace

// The wall and a point each move 0.4 m in a substep. So at some phases the point ends a substep further
// behind the wall than either moves alone.
TEST_CASE("a thin wall stops what flies towards it while it moves", "[numerics][contact]") {
    const double speed = 100, e = 0.5;
    std::vector<test::Item> items;
    for (int i = 0; i < 16; ++i)
        items.push_back(at({5 + i / 16.0 * speed / 120, 0, 0.2 * i - 1.5}));
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
    scene.groups[0].velocity = {-speed, 0, 0};
    scene.colliders = {collider(box({-0.025, -0.5, -4}, {0.025, 0.5, 4}), e, 0, 0.01)};
    scene.colliders[0].path = ride({speed, 0, 0});
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 3);
    for (const glm::dvec3& v : simulation.snapshot(0).velocities)
        CHECK(v.x == Approx(speed + 2 * e * speed).epsilon(1e-3));
}

// Deep in two that overlap, without gravity: along both normals, at 1 m/s.
TEST_CASE("what starts in two colliders leaves by both", "[numerics][contact]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog);
    scene.gravity = {};
    scene.colliders = {collider(box({-2, -2, -1}, {2, 0.1, 1}), 0.5, 0, 0.01),
                       collider(box({-2, -2, -1}, {0.1, 2, 1}), 0.5, 0, 0.01)};
    setSteps(scene, 1 / 60.0, 1);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 3);
    const glm::dvec3 way(std::sqrt(0.5) * 3 / 60, std::sqrt(0.5) * 3 / 60, 0);
    CHECK(glm::distance(simulation.snapshot(0).positions[0], way) < 1e-6);
}

// Two walls overlap by 0.2 m: their normals cancel, and the way out is up, where they end.
TEST_CASE("what starts between colliders that push against one another leaves upwards",
          "[numerics][contact]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog);
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {collider(box({-2, -2, -1}, {0.1, 0.3, 1}), 0, 1, 0.01),
                       collider(box({-0.1, -2, -1}, {2, 0.3, 1}), 0, 1, 0.01)};
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 60);
    const Snapshot now = simulation.snapshot(0);
    CHECK(now.positions[0].y == Approx(0.31).margin(1e-4));
    CHECK(glm::length(now.velocities[0]) < 1e-5);
}

// Back and forth between two walls, still or moving together: a way of 0.83 m a substep from one to the
// other, 0.18 m at a time.
TEST_CASE("five bounces in a substep keep the speed", "[numerics][contact]") {
    for (const double along : {0.0, 60.0}) {
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog);
        scene.gravity = {};
        scene.groups[0].velocity = {0, along - 200, 0};
        scene.colliders = {collider(box({-1, 0.1, -1}, {1, 0.2, 1}), 1, 0, 0.01),
                           collider(box({-1, -0.2, -1}, {1, -0.1, 1}), 1, 0, 0.01)};
        for (Collider& one : scene.colliders)
            if (along > 0) one.path = ride({0, along, 0});
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        for (int i = 1; i <= 20; ++i) {
            simulation.frame();
            const Snapshot now = simulation.snapshot(0);
            INFO("walls at " << along << " m/s, frame " << i);
            CHECK(std::abs(now.positions[0].y - along * i / 60) < 0.0905);
            CHECK(std::abs(now.velocities[0].y - along) == Approx(200).epsilon(1e-3));
        }
    }
}

// In the corner of two boxes a point touches both all the way; a third, thin, bars it.
TEST_CASE("a thin wall stops what slides along two others", "[numerics][contact]") {
    const double gap = 0.01 + 5e-6;  // near enough to touch
    Scene scene =
        test::sceneOf(test::point(1), SolverKind::leapfrog, {at({gap, gap, 0}), at({gap, gap, -0.2})});
    scene.gravity = {};
    scene.groups[0].velocity = {0, 0, 200};
    scene.colliders = {collider(box({-2, -2, -9}, {2, 0, 9}), 0.5, 0, 0.01),
                       collider(box({-2, -2, -9}, {0, 2, 9}), 0.5, 0, 0.01),
                       collider(box({-2, -2, 2}, {2, 2, 2.05}), 0.5, 0, 0.01)};
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 2);
    for (const glm::dvec3& v : simulation.snapshot(0).velocities)
        CHECK(glm::distance(v, {0, 0, -100}) < 0.01);
}

// So stiff that it answers as a rigid body, dropped on one of its faces on a floor that moves; and a point,
// which does not.
TEST_CASE("a floor that moves carries what lies on it, body or point", "[numerics][contact]") {
    const glm::dvec3 along(1, 0, 0.5);
    Molecule tetrahedron = test::leaf(1e6, 0);
    const glm::dvec3 corners[] = {{0, 0, 0}, {0.5, 0, 0}, {0.25, 0, 0.43}, {0.25, 0.4, 0.14}};
    for (size_t i = 0; i < 4; ++i)
        tetrahedron.vertices[i].position = corners[i];
    for (const bool body : {true, false}) {
        const SolverKind kind = body ? SolverKind::bdf2Xpbd : SolverKind::leapfrog;
        if (body && testPath() == Path::pingPong) continue;
        Scene scene = test::sceneOf(body ? tetrahedron : test::point(1), kind, {at({0, 0.02, 0})});
        scene.gravity = {0, -9.81, 0};
        scene.colliders = {collider(test::plane({0, 1, 0}), 0, 0.5, 0.01)};
        scene.colliders[0].path = ride(along);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 60);
        INFO((body ? "body" : "point"));
        for (const glm::dvec3& v : simulation.snapshot(0).velocities)
            CHECK(glm::distance(v, along) < 1e-4);
    }
}

// A point touches the floor and then the ramp, mostly in one substep; in the end only the ramp presses. In
// the second run all of them move down together.
TEST_CASE("what slides from a floor onto a ramp goes on along it", "[numerics][contact]") {
    const double junction = 0.01 - 0.01 * std::sqrt(2.0);
    for (const glm::dvec3& all : {glm::dvec3(0), glm::dvec3(0, -5, 0)}) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)
            items.push_back(at({junction - 0.0005 - 0.0008 * i - 0.147, 0.01 + 0.049, 0.1 * i}));
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
        scene.gravity = {};
        scene.groups[0].velocity = all + glm::dvec3(3, -1, 0);
        scene.colliders = {collider(test::plane({0, 1, 0}), 0, 0, 0.01),
                           collider(test::plane({-std::sqrt(0.5), std::sqrt(0.5), 0}), 0, 0, 0.01)};
        for (Collider& one : scene.colliders)
            if (all.y != 0) one.path = ride(all);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 6);
        for (const glm::dvec3& v : simulation.snapshot(0).velocities)
            CHECK(glm::distance(v, all + glm::dvec3(1.5, 1.5, 0)) < 1e-5);
    }
}

// By 0.6 rad a frame, about its own axis: nothing of its shape changes.
TEST_CASE("a point rests on a smooth roller that turns", "[numerics][contact]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at({0, 0.51, 0})});
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {collider(CapsuleCollider{{-1, 0, 0}, {1, 0, 0}, 0.5}, 0, 0, 0.01)};
    ColliderPath turning;
    for (int i = 0; i <= 20; ++i)
        turning.keyframes.push_back({i / 18.0, {{}, glm::angleAxis(2.0 * i, glm::dvec3(1, 0, 0))}});
    scene.colliders[0].path = turning;
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    for (int i = 0; i < 20; ++i) {
        simulation.frame();
        CHECK(simulation.snapshot(0).positions[0].y == Approx(0.51).margin(2e-6));
    }
}

// By 0.9 rad a frame, 0.22 m a substep where the points are: none is passed over.
TEST_CASE("a thin bar that turns strikes what it meets", "[numerics][contact]") {
    const double rate = 54, e = 0.5;
    std::vector<test::Item> items;
    for (int i = 0; i < 16; ++i) {
        const double angle = 0.4 + 0.225 * i / 16;
        items.push_back(at({std::cos(angle), 0, -std::sin(angle)}));
    }
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
    scene.gravity = {};
    scene.colliders = {collider(CapsuleCollider{{0, 0, 0}, {1.5, 0, 0}, 0.01}, e, 0, 0.01)};
    ColliderPath turning;
    for (int i = 0; i <= 3; ++i)
        turning.keyframes.push_back({2 * i / rate, {{}, glm::angleAxis(2.0 * i, glm::dvec3(0, 1, 0))}});
    scene.colliders[0].path = turning;
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    simulation.frame();
    // the straight way between two rotations turns a little faster in its middle
    for (const glm::dvec3& v : simulation.snapshot(0).velocities)
        CHECK(glm::length(v) == Approx((1 + e) * rate).epsilon(0.05));
}

// Gravity presses on all three of a corner; halves of drifts must not add up.
TEST_CASE("what rests in the corner of three planes stays", "[numerics][contact]") {
    for (const SolverKind kind : test::explicitSolvers()) {
        Scene scene = test::sceneOf(test::point(1), kind, {at({0.3, 0.2, 0.1}), at({0.01, 0.01, 0.01})});
        scene.gravity = {-4, -5, -6};
        scene.colliders = {collider(test::plane({1, 0, 0}), 0, 0.3, 0.01),
                           collider(test::plane({0, 1, 0}), 0, 0.3, 0.01),
                           collider(test::plane({0, 0, 1}), 0, 0.3, 0.01)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < 2; ++m) {
            INFO(name(kind) << ", point " << m);
            CHECK(glm::distance(now.positions[m], glm::dvec3(0.01)) < 1e-5);
            CHECK(glm::length(now.velocities[m]) < 1e-6);
        }
    }
}

TEST_CASE("verlet: between colliders the velocity is that of the positions, too", "[verlet][contact]") {
    const double h = 1 / 240.0;
    Scene scene =
        test::sceneOf(test::point(1), SolverKind::verlet, {at({0.02, 0.1, 0}), at({-0.03, 0.2, 0})});
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {collider(test::plane(glm::normalize(glm::dvec3(1, 1, 0))), 0, 0.3, 0.01),
                       collider(test::plane(glm::normalize(glm::dvec3(-1, 2, 0))), 0, 0.3, 0.01)};
    setSteps(scene, h, 1);
    Simulation simulation = test::simulationOf(scene);
    Snapshot before = simulation.snapshot(0);
    for (int i = 0; i < 90; ++i) {
        simulation.frame();
        const Snapshot now = simulation.snapshot(0);
        // positions round to 1.5e-8 m there
        for (size_t m = 0; m < 2; ++m)
            CHECK(glm::distance(now.velocities[m], (now.positions[m] - before.positions[m]) / h) < 2e-5);
        before = now;
    }
    CHECK(glm::length(simulation.snapshot(0).velocities[0]) < 1e-5);
}

TEST_CASE("however many colliders there are, all substeps of a frame are done", "[contact]") {
    // a CPU rasteriser leaves loops after 65,535 turns: 64 substeps of four vertices pass 60 balls, and look
    // again
    Simulation few = amongMany(60), many = amongMany(1000);
    test::run(few, 90);
    test::run(many, 90);
    CHECK(few.hash() == many.hash());
    CHECK(few.snapshot(0).positions[0].y < 0);
}

TEST_CASE("a way among very many colliders in one place ends the run instead of holding the device",
          "[contact]") {
    Simulation most = amongMany(0, 5000);
    const std::string message = messageOf([&] { test::run(most, 90), most.check(); });
    CHECK_THAT(message, Catch::Contains("was cut short"));
    // where passes go on with the rest of the frame, what was cut short is not finite at its end
    if (testPath() != Path::pingPong) CHECK_THAT(message, Catch::Contains("fewer colliders"));
}

TEST_CASE("what a paddle throws further than its own way meets the wall, among many colliders, too",
          "[contact]") {
    for (const int far : {0, 60}) {
        INFO(far);
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog,
                                    {at({0.25, 0, 0}), at({0.263, 0.1, 0}), at({0.221, -0.1, 0.1})});
        scene.gravity = glm::dvec3(0);
        setSteps(scene, 1 / 60.0, 1);
        Collider paddle;
        paddle.name = "paddle";
        paddle.shape = box({-0.8, -1, -1}, {0.2, 1, 1});
        paddle.path = ride({10, 0, 0});
        paddle.restitution = 0;
        scene.colliders = {paddle};
        scene.colliders.push_back({.name = "wall", .shape = box({0.3, -5, -5}, {0.35, 5, 5})});
        for (int i = 0; i < far; ++i)
            scene.colliders.push_back(
                {.name = concat("far ", i), .shape = SphereCollider{{50 + 3 * i, 0, 0}, 1}});
        REQUIRE((compile(scene).colliders.turns > 0) == (far > 0));
        Simulation simulation = test::simulationOf(scene);
        run(simulation,
            1);  // at rest until the paddle takes them along by up to 0.15 m, through where the wall is
        for (const glm::dvec3& x : simulation.snapshot(0).positions)
            CHECK(x.x < 0.3 + 1e-3);
    }
}

TEST_CASE("a molecule among many colliders moves as among those that are near it", "[contact]") {
    for (const glm::dvec3& start : {glm::dvec3(0.1, 0.6, 0.05), {-1.3, 0.5, 0.8}, {1.12, 0.7, -1.2}}) {
        glm::dvec3 end[2];
        for (const bool all : {false, true}) {
            Scene scene = test::swarm(test::shippedMolecule("quad"), 1, SolverKind::leapfrog);
            scene.gravity = {0, -9.81, 0};
            scene.solver.substeps = 4;
            scene.groups[0].drag = {1, 1};
            scene.groups[0].place.box = {start, start};
            for (int i = 0; i < 144; ++i) {
                const glm::dvec3 middle(0.37 * (i % 12 - 5.5), 0.05 * (i % 3), 0.37 * (i / 12 - 5.5));
                if (all || glm::distance(middle, start) < 1.1)
                    scene.colliders.push_back({.name = concat(i), .shape = SphereCollider{middle, 0.25}});
            }
            REQUIRE((compile(scene).colliders.turns > 0) == all);
            Simulation simulation(testContext(), compile(scene), {.path = testPath()});
            test::run(simulation, 40);
            end[all] = simulation.snapshot(0).positions[0];
        }
        CHECK(end[0].y > 0.1);
        CHECK(end[0].y < start.y - 0.1);
        CHECK(glm::distance(end[0], end[1]) < 1e-4);  // a collider that is missed makes centimetres
    }
}

}  // namespace shoal
