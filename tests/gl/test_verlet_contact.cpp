// verlet's contact as a constraint on the position [Jakobsen 2001], [Latta 2004]: what entered is moved out,
// and the velocity is what the moved positions leave.
#include <cmath>
#include <numbers>

#include "gl/agreement.h"
#include "support/catch.h"
#include "support/colliders.h"

using namespace shoal;
using test::at;
using test::collider;
using test::plane;
using test::run;
using test::setSteps;

namespace {

constexpr double g = 9.81, thickness = 0.01;

Scene dropped(std::vector<Collider> colliders, const glm::dvec3& from, const glm::dvec3& velocity) {
    Scene scene = test::sceneOf(test::point(1), SolverKind::verlet, {at(from)});
    scene.gravity = {0, -g, 0};
    scene.groups[0].velocity = velocity;
    scene.colliders = std::move(colliders);
    setSteps(scene, 1 / 240.0, 1);
    return scene;
}

// One plane takes the short way (a call a substep), two the joint one.
std::vector<Collider> grounds(int count, double friction) {
    std::vector<Collider> out(1, collider(plane({0, 1, 0}), 0.9, friction, thickness));
    if (count == 2) out.push_back(collider(SphereCollider{{100, 0, 0}, 1}, 0.9, friction, thickness));
    return out;
}

}  // namespace

TEST_CASE("verlet: what drops comes to rest without a bounce, its velocity that of its positions",
          "[verlet][contact]") {
    for (const int colliders : {1, 2}) {
        Simulation simulation =
            test::simulationOf(dropped(grounds(colliders, 0.5), {0, 0.35, 0}, {0.7, 0, 0}));
        const double h = 1 / 240.0;
        glm::dvec3 before = simulation.snapshot(0).positions[0];
        for (int i = 0; i < 200; ++i) {
            simulation.frame();
            const Snapshot now = simulation.snapshot(0);
            INFO(colliders << " colliders, frame " << i);
            // 6e-8 m a rounding of each position
            REQUIRE(glm::length(now.velocities[0] - (now.positions[0] - before) / h) < 1e-4);
            REQUIRE(now.velocities[0].y < 1e-4);  // never up
            REQUIRE(now.positions[0].y > thickness - 1e-6);
            before = now.positions[0];
        }
        CHECK(before.y == Approx(thickness).margin(1e-6));
        CHECK(glm::length(simulation.snapshot(0).velocities[0]) < 1e-6);
        run(simulation, 200);
        CHECK(glm::length(simulation.snapshot(0).positions[0] - before) < 1e-6);  // it does not creep
    }
}

TEST_CASE("verlet: friction on a slope is Coulomb's", "[verlet][contact]") {
    const double mu = 0.5, seconds = 1.5;
    for (const int joint : {0, 1}) {
        for (const double degrees : {15.0, 26.0, 28.0, 45.0}) {
            const double a = degrees * std::numbers::pi / 180;
            const glm::dvec3 normal{std::sin(a), std::cos(a), 0}, down{std::cos(a), -std::sin(a), 0};
            std::vector<Collider> colliders(1, collider(plane(normal), 0.3, mu, thickness));
            if (joint) colliders.push_back(collider(SphereCollider{{100, 0, 0}, 1}, 0.3, mu, thickness));
            Simulation simulation = test::simulationOf(dropped(colliders, thickness * normal, {}));
            const glm::dvec3 start = simulation.snapshot(0).positions[0];
            run(simulation, int(240 * seconds));
            const Snapshot now = simulation.snapshot(0);
            const double slide = g * (std::sin(a) - mu * std::cos(a));
            INFO(degrees << " degrees, " << (joint ? "joint" : "alone"));
            if (slide <= 0) {
                CHECK(glm::length(now.positions[0] - start) < 1e-4);
                CHECK(glm::length(now.velocities[0]) < 1e-4);
            } else {
                CHECK(glm::dot(now.velocities[0], down) / seconds == Approx(slide).epsilon(0.01));
            }
        }
    }
}

TEST_CASE("verlet: what starts inside comes out without being shot", "[verlet][contact]") {
    for (const int colliders : {1, 2}) {
        Simulation simulation = test::simulationOf(dropped(grounds(colliders, 0.5), {0, -0.5, 0}, {0, 0, 0}));
        double fastest = 0;
        for (int i = 0; i < 400; ++i) {
            simulation.frame();
            fastest = std::max(fastest, simulation.snapshot(0).velocities[0].y);
        }
        INFO(colliders << " colliders");
        CHECK(fastest < 1.01);  // pushSpeed
        CHECK(simulation.snapshot(0).positions[0].y == Approx(thickness).margin(1e-5));
    }
}

TEST_CASE("verlet: the two paths agree on contact", "[verlet][contact][fused][agreement]") {
    if (!test::canFuse()) return;
    for (const int colliders : {1, 2}) {
        std::vector<test::Item> items;
        for (int i = 0; i < 60; ++i)
            items.push_back(at({i % 8 * 1.5, 0.6 + 0.05 * i, i / 8 * 1.5}, test::turned(), 0.75));
        Scene scene = test::sceneOf(test::leaf(400, 2), SolverKind::verlet, items);
        scene.gravity = {0, -g, 0};
        scene.colliders = grounds(colliders, 0.5);
        setSteps(scene, 1 / 60.0, 4);
        test::Agreement agreement(scene, {.path = Path::fused}, {.path = Path::pingPong});
        for (const int frame : {20, 60}) {
            const test::Comparison c = agreement.at(frame);
            INFO(colliders << " colliders, frame " << frame << ": " << text(c));
            CHECK(c.wrong == 0);
            CHECK(c.excepted <= 3);
        }
    }
}
