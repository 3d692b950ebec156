// Contact against closed forms that know no step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hard/outcome.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using test::at;
using test::Judge;
using test::plane;
using test::run;
using test::setSteps;

namespace {

constexpr double g = 9.81, thickness = 0.01;

Collider collider(ColliderShape shape, double restitution, double friction) {
    return test::collider(std::move(shape), restitution, friction, thickness);
}

// A method of order 1 keeps a velocity that lags half a step behind its position (physics/collide.glsl).
double lagOf(const Solver& solver, double h) {
    return solver.order == 1 ? h / 2 : 0;
}

// A valley or a ridge along z, straight slopes of 0.5 on both sides of x = 0, cells of 0.25 m.
HeightFieldCollider crease(double slope) {
    HeightFieldCollider out;
    out.columns = out.rows = 33;
    out.low = {-4, -4}, out.high = {4, 4};
    for (int z = 0; z < out.rows; ++z) {
        for (int x = 0; x < out.columns; ++x)
            out.heights.push_back(float(slope * std::abs(0.25 * x - 4)));
    }
    return out;
}

// Highest point above the rest surface after the first bounce, from energy where the frame cuts the arc.
std::vector<double> bounceHeights(const Solver& solver, Simulation& simulation, int count, double h) {
    std::vector<double> best(size_t(count), 0), last(size_t(count), 1e9);
    std::vector<int> bounces(size_t(count), 0);
    for (int i = 0; i < 300; ++i) {
        simulation.frame();
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < best.size(); ++m) {
            const double v = now.velocities[m].y - g * lagOf(solver, h),
                         height = now.positions[m].y - thickness;
            if (now.velocities[m].y > last[m] + 1e-3) ++bounces[m];
            last[m] = now.velocities[m].y;
            if (bounces[m] == 1) best[m] = std::max(best[m], height + (v > 0 ? v * v / (2 * g) : 0));
        }
    }
    for (size_t m = 0; m < best.size(); ++m)
        if (bounces[m] == 0) best[m] = -1;
    return best;
}

}  // namespace

// From a height H a bounce reaches e^2 H, whatever the phase of the impact within a step. H is 0.1 m, so that
// a step's gravity would show: it is 3 % of the speed of the impact.
TEST_CASE("hard: a bounce", "[hard][contact]") {
    const double h = 1 / 240.0;
    for (double e : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        test::holds(concat("bounce, restitution ", e), [&](const Solver& solver, Judge& judge) {
            std::vector<test::Item> items;
            std::vector<double> drops;
            for (int phase = 0; phase < 16; ++phase) {
                drops.push_back(0.1 + phase / 16.0 * std::sqrt(0.2 * g) * h);
                items.push_back(at({3 * phase, drops.back() + thickness, 0}));
            }
            Scene scene = test::sceneOf(test::point(1), solver.kind, items);
            scene.gravity = {0, -g, 0};
            // friction must not matter, so that there is some speed along the plane
            scene.groups[0].velocity = {0.7, g * lagOf(solver, h), 0};
            scene.colliders = {collider(plane({0, 1, 0}), e, 0.4)};
            setSteps(scene, h, 1);
            Simulation simulation = test::hardSimulation(scene);
            const std::vector<double> heights = bounceHeights(solver, simulation, 16, h);
            for (size_t m = 0; m < 16; ++m)  // +-2 %; without restitution 0.1 mm of 0.1 m
                judge.near("ratio", heights[m] / drops[m], e * e, e > 0 ? 0.02 * e * e : 0.001);
        });
    }
}

// Coulomb: slides with a = g (sin a - mu cos a), or holds where tan a < mu; at 1, 4 and 16 substeps alike.
TEST_CASE("hard: an incline", "[hard][contact]") {
    const double mu = 0.5, seconds = 1.5;
    const auto incline = [&](const Solver& solver, Judge& judge, double degrees) {
        const double a = degrees * std::numbers::pi / 180, slide = g * (std::sin(a) - mu * std::cos(a));
        const glm::dvec3 normal{std::sin(a), std::cos(a), 0}, down{std::cos(a), -std::sin(a), 0};
        Scene scene = test::sceneOf(test::point(1), solver.kind,
                                    {at(thickness * normal), at(thickness * normal - 4.0 * down)});
        scene.gravity = {0, -g, 0};
        scene.colliders = {collider(plane(normal), 0.3, mu)};
        for (int substeps : {1, 4, 16}) {
            setSteps(scene, 1 / 60.0, substeps);
            Simulation simulation = test::hardSimulation(scene);
            const Snapshot start = simulation.snapshot(0);
            test::runChecked(simulation, int(std::lround(60 * seconds)));
            const Snapshot now = simulation.snapshot(0);
            for (size_t m = 0; m < 2; ++m) {
                if (slide <= 0) {  // at most 90 frames of float's 1e-7 m
                    judge.atMost("crept m", glm::length(now.positions[m] - start.positions[m]), 1e-5);
                } else {
                    judge.near("a / expected", glm::dot(now.velocities[m], down) / seconds / slide, 1, 0.01);
                    judge.near("off the plane m", glm::dot(now.positions[m], normal) - thickness, 0, 1e-3);
                }
            }
        }
    };
    for (double degrees : {15.0, 26.0, 28.0, 45.0})  // atan mu is 26.6
        test::holds(concat("incline of ", degrees, " degrees"),
                    [&](const Solver& s, Judge& judge) { incline(s, judge, degrees); });
}

// Dropped from 1 cm: at rest (1 mm/s) within 1 s, and then still for another 2 s: no vertex of a tetrahedron
// is faster than 1e-5 m/s, on which its springs' rounding is most.
TEST_CASE("hard: resting contact", "[hard][contact]") {
    const auto rest = [](const Solver& solver, Judge& judge, const Molecule& molecule, double lift,
                         const ColliderShape& ground, const glm::dquat& turn = {1, 0, 0, 0}) {
        std::vector<test::Item> items;
        for (int i = 0; i < 8; ++i)
            items.push_back(at({2.0 * i, lift + thickness + 0.01 + 0.001 * i, 0}, turn));
        Scene scene = test::sceneOf(molecule, solver.kind, items);
        scene.gravity = {0, -g, 0};
        scene.colliders = {collider(ground, 0.2, 0.5)};
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        const auto fastest = [&](const Snapshot& now) {
            double out = 0;
            for (const glm::dvec3& v : now.velocities)
                out = std::max(out, glm::length(v));
            return out;
        };
        test::runChecked(simulation, 60);
        const Snapshot settled = simulation.snapshot(0);
        judge.atMost("m/s after 1 s", fastest(settled), 1e-3);
        for (int i = 0; i < 12; ++i) {
            test::runChecked(simulation, 10);
            const Snapshot now = simulation.snapshot(0);
            for (size_t v = 0; v < now.positions.size(); ++v) {
                // below what a picture shows by far; contact takes every drift back to the bit where it can
                judge.atMost("then m", glm::length(now.positions[v] - settled.positions[v]), 1e-6);
            }
        }
        judge.atMost("m/s after 3 s", fastest(simulation.snapshot(0)), 1e-5);
    };
    const ColliderShape flat = plane({0, 1, 0});
    BoxCollider box;
    box.center = {7, -0.5, 0}, box.size = {20, 1, 4};
    test::holds("resting point",
                [&](const Solver& s, Judge& judge) { rest(s, judge, test::point(1), 0, flat); });
    test::holds("resting tetrahedron",
                [&](const Solver& s, Judge& judge) { rest(s, judge, test::tetrahedron(2000, 40), 0, flat); });
    // with the end of a spring that hangs above it and pushes with ten times its weight
    Molecule foot = test::pair(1, 1, 2000, 40);
    foot.vertices[1].pinned = true;
    foot.springs[0].restLength = 1.05;
    test::holds("resting point under a load", [&](const Solver& s, Judge& judge) {
        rest(s, judge, foot, 0, flat, glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 0, 1)));
    });
    test::holds("resting tetrahedron on a box",
                [&](const Solver& s, Judge& judge) { rest(s, judge, test::tetrahedron(2000, 40), 0, box); });
}

// 200 m/s is 0.83 m a step. A plane and a height field are solid all the way down: nothing gets below them. A
// ball of 0.05 m is looked for along the way.
TEST_CASE("hard: 200 m/s at a wall", "[hard][contact]") {
    const auto shoot = [](const Solver& solver, Judge& judge, ColliderShape shape, double radius) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)  // at all phases of a step
            items.push_back(at({0, 10 + i / 16.0 * 200 / 240, 0}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.groups[0].velocity = {0, -200, 0};
        scene.colliders = {collider(std::move(shape), 0.5, 0)};
        setSteps(scene, 1 / 240.0, 1);
        Simulation simulation = test::hardSimulation(scene);
        int crossed = 0;
        test::runChecked(simulation, 60);
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < now.positions.size(); ++m)
            crossed += now.positions[m].y < radius;
        judge.atMost("crossed of 16", crossed, 0);
    };
    SphereCollider ball;
    ball.radius = 0.025;
    test::holds("200 m/s at a plane", [&](const Solver& s, Judge& judge) {
        shoot(s, judge, plane({0, 1, 0}), thickness - 1e-4);
    });
    test::holds("200 m/s at a height field",
                [&](const Solver& s, Judge& judge) { shoot(s, judge, crease(0), thickness - 1e-4); });
    test::holds("200 m/s at a ball of 0.05 m",
                [&](const Solver& s, Judge& judge) { shoot(s, judge, ball, 0.03); });
}

// Falling at 3 to 5 m/s onto a fold, where two normals meet: never deeper than half a cell, at the end
// outside.
TEST_CASE("hard: a crease", "[hard][contact]") {
    const auto fall = [](const Solver& solver, Judge& judge, double slope) {
        std::vector<test::Item> items;
        for (int i = 0; i < 25; ++i)
            items.push_back(at({0.05 * (i % 5 - 2), 0.5 + 0.2 * (i / 5), 0.07 * (i % 5)}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = {0, -g, 0};
        scene.colliders = {collider(crease(slope), 0.3, 0.3)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        const auto depth = [&](const Snapshot& now) {
            double out = 0;
            for (const glm::dvec3& x : now.positions)
                if (std::abs(x.x) < 4 && std::abs(x.z) < 4) out = std::max(out, slope * std::abs(x.x) - x.y);
            return out;
        };
        for (int i = 0; i < 120; ++i) {
            test::runChecked(simulation, 1);
            judge.atMost("deepest m", depth(simulation.snapshot(0)), 0.125);
        }
        judge.atMost("at the end m", depth(simulation.snapshot(0)), 0.5 * thickness);
    };
    test::holds("height field, valley", [&](const Solver& s, Judge& judge) { fall(s, judge, 0.5); });
    test::holds("height field, ridge", [&](const Solver& s, Judge& judge) { fall(s, judge, -0.5); });
}

// Onto the pole of a sphere, where every way down is as good, and from its very middle, where the normal is
// 0/0.
TEST_CASE("hard: the pole of a sphere", "[hard][contact]") {
    test::holds("sphere, pole and middle", [](const Solver& solver, Judge& judge) {
        const double radius = 0.5;
        std::vector<test::Item> items{at({0, 0, 0}), at({0, 1e-12, 0}), at({0, 0.2, 0})};
        for (int i = 0; i < 13; ++i)
            items.push_back(at({i % 2 * 1e-7, 0.6 + 0.1 * i, 0}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = {0, -g, 0};
        SphereCollider sphere;
        sphere.radius = radius;
        scene.colliders = {collider(sphere, 0.3, 0.5)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        double deepest = 0;
        for (int i = 0; i < 120; ++i) {
            test::runChecked(simulation, 1);
            const Snapshot now = simulation.snapshot(0);
            judge.finite(now);
            // the first three start inside, and come out at 1 m/s
            for (size_t m = i < 45 ? 3 : 0; m < now.positions.size(); ++m)
                deepest = std::max(deepest, radius - glm::length(now.positions[m]));
        }
        judge.atMost("deepest m", deepest, 1e-4);
    });
}

}  // namespace shoal
