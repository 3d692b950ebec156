// Contact on the GPU: bounce, slope and rest against closed forms that know no step.
#include <cmath>
#include <numbers>

#include "gl/numerics.h"
#include "reference/colliders.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using test::bothSolvers;
using test::run;
using test::setSteps;

namespace {

constexpr double g = 9.81;

Collider collider(ColliderShape shape, double restitution, double friction) {
    Collider out;
    out.shape = std::move(shape);
    out.restitution = restitution;
    out.friction = friction;
    out.thickness = 0.01;
    return out;
}

PlaneCollider plane(const glm::dvec3& point, const glm::dvec3& normal) {
    PlaneCollider out;
    out.point = point;
    out.normal = normal;
    return out;
}

// Gentle waves on a grid of 0.25 m, with a flat rim. The height at a sample, and between them bilinear.
HeightFieldCollider waves(bool sampledNormals) {
    HeightFieldCollider out;
    out.columns = 41, out.rows = 33;
    out.low = {-5, -4}, out.high = {5, 4};
    out.sampledNormals = sampledNormals;
    for (int z = 0; z < out.rows; ++z) {
        for (int x = 0; x < out.columns; ++x) {
            out.heights.push_back(
                float(0.3 * std::sin(0.9 * (0.25 * x - 5)) * std::cos(0.7 * (0.25 * z - 4))));
        }
    }
    return out;
}

double heightOf(const HeightFieldCollider& field, double x, double z) {
    const double i = (x - field.low.x) / 0.25, k = (z - field.low.y) / 0.25;
    const int column = std::min(int(i), field.columns - 2), row = std::min(int(k), field.rows - 2);
    const double fx = i - column, fz = k - row;
    auto sample = [&](int dx, int dz) {
        return double(field.heights[size_t(row + dz) * size_t(field.columns) + size_t(column + dx)]);
    };
    return (sample(0, 0) * (1 - fx) + sample(1, 0) * fx) * (1 - fz) +
           (sample(0, 1) * (1 - fx) + sample(1, 1) * fx) * fz;
}

}  // namespace

// A point flies past the upper edge of a box, or the side of a ball, nearer and nearer to head-on; both are
// rounded, the edge by the collider's thickness only.
TEST_CASE("what meets an edge or a ball leaves by the normal of the touch", "[numerics][contact]") {
    const double speed = 3, e = 0.6;
    for (const bool ball : {false, true}) {
        const double radius = ball ? 0.3 : 0.002;
        for (const int substeps : {1, 8}) {
            std::vector<test::Item> items;
            for (int i = 0; i < 12; ++i)
                items.push_back(at({-0.4 - 0.013 * i, radius * (0.05 + 0.07 * i), 0.3 * i}));
            Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
            scene.groups[0].velocity = {speed, 0, 0};
            Collider one = collider(BoxCollider{{1, -1, 0}, {2, 2, 40}}, e, 0);
            if (ball) {
                one.shape = CapsuleCollider{{0, 0, -20}, {0, 0, 20}, 0.299};
                one.thickness = 0.001;
            } else {
                one.thickness = radius;
            }
            scene.colliders = {one};
            setSteps(scene, 1 / 60.0, substeps);
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 20);
            const Snapshot now = simulation.snapshot(0);
            for (size_t i = 0; i < items.size(); ++i) {
                const double sine = items[i].position.y / radius;
                const glm::dvec3 n(-std::sqrt(1 - sine * sine), sine, 0);
                const glm::dvec3 v = glm::dvec3(speed, 0, 0) - n * ((1 + e) * speed * n.x);
                CAPTURE(ball, substeps, i);
                CHECK(glm::distance(now.velocities[i], v) < (ball ? 6e-5 : 4e-4));
            }
        }
    }
}

TEST_CASE("passes: points come to rest on a plane, a sphere's top and a height field, and stay",
          "[numerics][contact]") {
    for (SolverKind kind : bothSolvers) {
        for (int shape = 0; shape < 4; ++shape) {
            std::vector<test::Item> items;
            SphereCollider sphere;
            sphere.center = {1, 2, 3};
            sphere.radius = 0.7;
            const HeightFieldCollider field = waves(shape == 3);
            for (int i = 0; i < 25; ++i) {
                const double x = i % 5 - 2, z = i / 5 - 2;
                if (shape == 1) {
                    items.push_back(at({1 + 0.02 * x, 2.9, 3 + 0.02 * z}));
                } else {
                    items.push_back(at({x * 0.93, 0.8, z * 0.77}));
                }
            }
            Scene scene = test::sceneOf(test::point(1), kind, items);
            scene.gravity = {0, -g, 0};
            scene.groups[0].velocity = {0.05, 0, 0};
            const ColliderShape shapes[] = {plane({0, 0.2, 0}, {0, 1, 0}), sphere, field, field};
            scene.colliders = {collider(shapes[shape], 0.1, 1.0)};
            if (shape >= 2) scene.colliders[0].thickness = 0.1;
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 120);
            const Snapshot rest = simulation.snapshot(0);
            run(simulation, 120);
            const Snapshot later = simulation.snapshot(0);
            for (size_t m = 0; m < items.size(); ++m) {
                const glm::dvec3 x = later.positions[m];
                INFO(name(kind) << " shape " << shape << " point " << m << " at " << x.x << " " << x.y << " "
                                << x.z);
                CHECK(glm::length(later.velocities[m]) < 1e-6);
                CHECK(glm::length(x - rest.positions[m]) < 1e-6);
                if (shape == 0) CHECK(x.y == Approx(0.21).margin(1e-5));
                if (shape == 1) CHECK(glm::length(x - sphere.center) == Approx(0.71).margin(1e-5));
                if (shape < 2) continue;
                // thickness is along the normal, so that it is more along y on a slope
                const double slopeX = 0.27 * std::cos(0.9 * x.x) * std::cos(0.7 * x.z);
                const double slopeZ = -0.21 * std::sin(0.9 * x.x) * std::sin(0.7 * x.z);
                const double expected = 0.1 * std::sqrt(1 + slopeX * slopeX + slopeZ * slopeZ);
                // the normal from samples 0.25 m apart is off by up to 0.03: 0.1 of it counts, times the
                // slope
                CHECK(x.y - heightOf(field, x.x, x.z) == Approx(expected).margin(0.001));
            }
        }
    }
}

// Contact puts what is inside onto the surface, along the normal, in one long step without gravity. Some
// start beside the field, where there is nothing, and some in its outermost cells.
TEST_CASE("height field: the shader's surface is the reference's, up to its borders", "[numerics][contact]") {
    for (const bool sampledNormals : {false, true}) {
        std::vector<test::Item> items;
        for (int i = 0; i < 24; ++i)
            for (int k = 0; k < 24; ++k)
                items.push_back(at({-5.4 + 0.47 * i, -0.45, -4.37 + 0.379 * k}));
        Scene scene = test::sceneOf(test::point(1), SolverKind::euler, items);
        scene.gravity = {};
        scene.colliders = {collider(waves(sampledNormals), 0, 0)};
        setSteps(scene, 1, 1);
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 1);
        const Snapshot now = simulation.snapshot(0);
        double worst = 0;
        for (size_t i = 0; i < items.size(); ++i) {
            const reference::Surface s = reference::surfaceAt(*scene.colliders[0].shape, items[i].position);
            const double depth = std::max(0.0, 0.01 - s.distance);
            worst = std::max(worst, glm::distance(now.positions[i], items[i].position + depth * s.normal));
        }
        CAPTURE(sampledNormals);
        CHECK(worst < 3e-6);
    }
}

TEST_CASE("passes: friction holds what a spring pulls on, up to mu m g", "[numerics][contact]") {
    const double mu = 0.5, k = 100;
    for (SolverKind kind : bothSolvers) {
        for (double share : {0.6, 0.95, 1.2}) {
            Molecule molecule = test::pair(1, 1, k, 1);
            molecule.springs[0].restLength = 1 - share * mu * g / k;
            Scene scene = test::sceneOf(molecule, kind, {at({-0.5, 0.01, 0})});
            scene.gravity = {0, -g, 0};
            scene.colliders = {collider(plane({0, 0, 0}, {0, 1, 0}), 0.3, mu)};
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::simulationOf(scene);
            const Snapshot start = simulation.snapshot(0);
            run(simulation, 120);
            const Snapshot now = simulation.snapshot(0);
            const double closer = now.positions[0].x - start.positions[0].x;
            INFO(name(kind) << " share " << share << " moved " << closer);
            CHECK(now.positions[0].y == Approx(0.01).margin(1e-5));
            if (share < 1) {
                CHECK(std::abs(closer) < 1e-6);
            } else {
                // slides like a damped block until it stops short of where friction holds it
                CHECK(closer > 0.001);
                CHECK(glm::length(now.velocities[0]) < 1e-6);
            }
        }
    }
}

// Springs press and pull on vertices that rest: none of that may move what friction holds.
TEST_CASE("passes: leaves land on the flat and on a slope, and stay", "[numerics][contact]") {
    for (SolverKind kind : bothSolvers) {
        for (double degrees : {0.0, 20.0}) {
            const double a = degrees * std::numbers::pi / 180;
            const glm::dvec3 normal{std::sin(a), std::cos(a), 0};
            std::vector<test::Item> items;
            for (int i = 0; i < 16; ++i) {
                const glm::dvec3 axis = glm::normalize(glm::dvec3(i - 7.5, 3, 2));
                items.push_back(at({i % 4 * 1.5 - 2, 1.6 + 0.05 * i, i / 4 * 1.5 - 2},
                                   glm::angleAxis(0.4 * i, axis), 0.5));
            }
            Scene scene = test::sceneOf(test::leaf(2000, 20), kind, items);
            scene.gravity = {0, -g, 0};
            scene.groups[0].drag = {4, 0.5};
            scene.colliders = {collider(plane({0, 0, 0}, normal), 0.1, 0.6)};
            setSteps(scene, 1 / 60.0, 8);
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 300);
            const Snapshot rest = simulation.snapshot(0);
            run(simulation, 60);
            const Snapshot later = simulation.snapshot(0);
            double lowest = 1, fastest = 0, moved = 0;
            for (size_t i = 0; i < later.positions.size(); ++i) {
                lowest = std::min(lowest, glm::dot(later.positions[i], normal));
                fastest = std::max(fastest, glm::length(later.velocities[i]));
                moved = std::max(moved, glm::length(later.positions[i] - rest.positions[i]));
            }
            UNSCOPED_INFO(name(kind) << " slope " << degrees << " lowest " << lowest << " fastest " << fastest
                                     << " moved " << moved);
            CHECK(lowest > 0.01 - 1e-4);
            CHECK(fastest < 1e-6);
            CHECK(moved < 1e-6);  // none at all where contact takes every drift back exactly
        }
    }
}

}  // namespace shoal
