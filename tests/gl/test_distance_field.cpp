// Distance fields on the GPU: the surface's own text against its definition in double, and contact with it.
#include <algorithm>
#include <cmath>

#include "gl/numerics.h"
#include "reference/colliders.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/solids.h"

namespace shoal {

using test::at;
using test::bothSolvers;
using test::run;
using test::setSteps;

namespace {

constexpr double g = 9.81, thickness = 0.01;

Collider fieldOf(Mesh mesh, int resolution, double restitution, double friction) {
    completeMesh(mesh);
    DistanceFieldCollider shape;
    shape.request.resolution = resolution;
    shape.request.thickness = thickness;
    shape.field = bakeDistanceField(mesh, shape.request);
    Collider out;
    out.shape = std::move(shape);
    out.restitution = restitution;
    out.friction = friction;
    out.thickness = thickness;
    return out;
}

Mesh box(const glm::dvec3& low, const glm::dvec3& high) {
    Mesh mesh;
    test::addBox(mesh, low, high);
    return mesh;
}

Mesh torus() {
    Mesh mesh;
    test::addTorus(mesh, {0.3, 1, -0.2}, 1, 0.35, 48, 24);
    return mesh;
}

}  // namespace

// In one step without gravity, contact moves points from inside onto the surface, along the normal, and so
// shows where the shader has its surface. The step is long, because contact moves a point no faster than
// pushSpeed (physics/collide.glsl).
TEST_CASE("distance field: the shader's surface is the reference's", "[numerics][contact][distanceField]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::euler);
    scene.colliders = {fieldOf(torus(), 24, 0, 0)};
    std::vector<test::Item> items;
    for (int i = 1; i <= 3000; ++i) {
        const glm::dvec3 share = glm::fract(double(i) * glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779));
        items.push_back(at(glm::dvec3(-1.4, 0.4, -1.9) + share * glm::dvec3(3.4, 1.2, 3.4)));
    }
    scene = [&] {
        Scene out = test::sceneOf(test::point(1), SolverKind::euler, items);
        out.colliders = scene.colliders;
        return out;
    }();
    setSteps(scene, 1, 1);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 1);
    const Snapshot now = simulation.snapshot(0);
    int pushed = 0;
    double worst = 0;
    for (size_t i = 0; i < items.size(); ++i) {
        const reference::Surface s = reference::surfaceAt(*scene.colliders[0].shape, items[i].position);
        const double depth = std::max(0.0, thickness - s.distance);
        pushed += depth > 0;
        worst = std::max(worst, glm::distance(now.positions[i], items[i].position + depth * s.normal));
    }
    CHECK(pushed > 300);
    CHECK(worst < 3e-6);
}

TEST_CASE("distance field: a bounce reaches e^2 of its height", "[numerics][contact][distanceField]") {
    const double h = 1 / 240.0, e = 0.7;
    for (SolverKind kind : bothSolvers) {
        std::vector<test::Item> items;
        for (int phase = 0; phase < 16; ++phase)
            items.push_back(
                at({0.1 * phase - 0.75, 0.5 + thickness + phase / 16.0 * std::sqrt(g) * h, 0.013 * phase}));
        Scene scene = test::sceneOf(test::point(1), kind, items);
        scene.gravity = {0, -g, 0};
        scene.groups[0].velocity = {0, kind == SolverKind::euler ? g * h / 2 : 0, 0};
        scene.colliders = {fieldOf(box({-1, -1, -1}, {1, 0, 1}), 32, e, 0.4)};
        setSteps(scene, h, 1);
        Simulation simulation = test::simulationOf(scene);
        std::vector<double> best(16, 0);
        for (int i = 0; i < 140; ++i) {
            simulation.frame();
            const Snapshot now = simulation.snapshot(0);
            for (size_t m = 0; m < 16; ++m) {
                const double v = now.velocities[m].y - (kind == SolverKind::euler ? g * h / 2 : 0);
                if (i > 76 && now.velocities[m].y > 0)
                    best[m] = std::max(best[m], now.positions[m].y - thickness + v * v / (2 * g));
            }
        }
        for (size_t m = 0; m < 16; ++m) {
            INFO(name(kind) << " phase " << m);
            const double drop = items[m].position.y - thickness;
            CHECK(best[m] / drop == Approx(e * e).epsilon(0.02));
        }
    }
}

TEST_CASE("distance field: points come to rest, on flat and round places, and stay",
          "[numerics][contact][distanceField]") {
    for (SolverKind kind : bothSolvers) {
        for (bool round : {false, true}) {
            std::vector<test::Item> items;
            for (int i = 0; i < 25; ++i) {
                const double a = 0.25 * i;
                items.push_back(round ? at({0.3 + 0.98 * std::cos(a), 1.5, -0.2 + 0.98 * std::sin(a)})
                                      : at({0.3 * (i % 5 - 2), 0.1, 0.31 * (i / 5 - 2)}));
            }
            Scene scene = test::sceneOf(test::point(1), kind, items);
            scene.gravity = {0, -g, 0};
            scene.groups[0].velocity = {0.05, 0, 0};
            scene.colliders = {round ? fieldOf(torus(), 48, 0.1, 1.0)
                                     : fieldOf(box({-1, -1, -1}, {1, 0, 1}), 32, 0.1, 1.0)};
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 120);
            const Snapshot rest = simulation.snapshot(0);
            run(simulation, 120);
            const Snapshot later = simulation.snapshot(0);
            for (size_t m = 0; m < items.size(); ++m) {
                INFO(name(kind) << " round " << round << " point " << m << " at " << later.positions[m].y);
                CHECK(glm::length(later.velocities[m]) < 1e-6);
                CHECK(glm::length(later.positions[m] - rest.positions[m]) < 1e-6);
                // what is looked for along the way is touched from 1e-5 m on (step/joint_contact.glsl)
                if (!round) CHECK(later.positions[m].y == Approx(thickness).margin(1.2e-5));
                const reference::Surface s =
                    reference::surfaceAt(*scene.colliders[0].shape, later.positions[m]);
                CHECK(s.distance == Approx(thickness).margin(1.5e-5));
            }
        }
    }
}

// A field 100 km away: positions are relative to anchors there.
// Through the slab the way of a substep is 0.8 m.
TEST_CASE("distance field: a slab stops what is fast", "[numerics][contact][distanceField]") {
    std::vector<test::Item> items;
    for (int i = 0; i < 16; ++i)
        items.push_back(at({0.05 * (i - 8), 5 + i / 16.0 * 200 / 240, 0.03 * (i % 5)}));
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
    scene.groups[0].velocity = {0, -200, 0};
    scene.colliders = {fieldOf(box({-1, -0.05, -1}, {1, 0.05, 1}), 40, 0.5, 0)};
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 3);
    for (const glm::dvec3& v : simulation.snapshot(0).velocities)
        CHECK(glm::distance(v, {0, 100, 0}) < 0.1);
}

// Where a field is level, the way out is the direction away from its middle, and upwards in the middle
// itself.
TEST_CASE("distance field: what starts where it is level comes out", "[numerics][contact][distanceField]") {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog,
                                {at({0.1, 0, 0}), at({0, 0, -0.1}), at({0, 0, 0})});
    scene.gravity = {};
    Collider cube = fieldOf(box(glm::dvec3(-0.25), glm::dvec3(0.25)), 16, 0, 0);
    for (float& distance : std::get<DistanceFieldCollider>(*cube.shape).field.distances)
        distance = std::max(distance, -0.05f);
    scene.colliders = {cube};
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 60);
    const Snapshot now = simulation.snapshot(0);
    CHECK(now.positions[0].x == Approx(0.26).margin(0.01));
    CHECK(now.positions[1].z == Approx(-0.26).margin(0.01));
    CHECK(now.positions[2].y == Approx(0.26).margin(0.01));
}

// With few colliders, the nearest surface alone answers where that is enough. With ten, the whole way is
// followed.
TEST_CASE("distance field: the nearest surface answers as following the way does",
          "[numerics][contact][distanceField]") {
    std::vector<test::Item> items;
    for (int i = 1; i <= 3000; ++i) {
        const glm::dvec3 share = glm::fract(double(i) * glm::dvec3(0.8191725134, 0.6710436067, 0.5497004779));
        // around the edge where the box stands on the ground, up to 3 cm inside either
        items.push_back(at(glm::dvec3(0.97, -0.03, -0.5) + share * glm::dvec3(0.09, 0.09, 1)));
    }
    const auto after = [&](const glm::dvec3& velocity, int far) {
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
        scene.gravity = {0, -g, 0};
        scene.groups[0].velocity = velocity;
        Collider ground;
        ground.shape = PlaneCollider{};
        ground.friction = 0.3, ground.restitution = 0.3, ground.thickness = thickness;
        scene.colliders = {fieldOf(box({-1, -1, -1}, {1, 1, 1}), 64, 0.3, 0.3), ground};
        for (int i = 0; i < far; ++i) {
            SphereCollider ball;
            ball.center = {0, -1000, 3.0 * i};
            scene.colliders.emplace_back();
            scene.colliders.back().shape = ball;
        }
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 3);
        return simulation.snapshot(0);
    };
    for (const glm::dvec3& velocity : {glm::dvec3(0), glm::dvec3(-2, -1, 0.3), glm::dvec3(0.5, -2.5, 0)}) {
        const Snapshot nearest = after(velocity, 0), followed = after(velocity, 8);
        double apart = 0, changed = 0;
        for (size_t i = 0; i < items.size(); ++i) {
            apart = std::max(apart, glm::distance(nearest.positions[i], followed.positions[i]));
            changed = std::max(changed, glm::distance(nearest.velocities[i], followed.velocities[i]));
        }
        INFO("thrown at " << velocity.x << ", " << velocity.y);
        CHECK(apart < 1e-6);
        CHECK(changed < 1e-5);
    }
}

TEST_CASE("distance field: far from the origin as near it", "[numerics][contact][distanceField]") {
    const glm::dvec3 far(1e5, -2e4, 5e4);
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, {at(far + glm::dvec3(0.2, 0.3, 0.1))});
    scene.gravity = {0, -g, 0};
    scene.colliders = {fieldOf(box(far + glm::dvec3(-1, -1, -1), far + glm::dvec3(1, 0, 1)), 32, 0, 1)};
    setSteps(scene, 1 / 60.0, 4);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 120);
    const Snapshot now = simulation.snapshot(0);
    CHECK(glm::length(now.velocities[0]) < 1e-6);
    CHECK(now.positions[0].y - far.y == Approx(thickness).margin(1e-4));
}

}  // namespace shoal
