// Contact with several colliders, thin ones and moving ones.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "hard/outcome.h"
#include "molecule/analysis.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using test::at;
using test::Judge;
using test::plane;
using test::setSteps;

namespace {

constexpr double g = 9.81, thickness = 0.01;
const glm::dvec3 down{0, -g, 0};

Collider collider(ColliderShape shape, double restitution, double friction) {
    return test::collider(std::move(shape), restitution, friction, thickness);
}

// From one place to another at a constant speed, then it holds.
ColliderPath ride(const glm::dvec3& velocity, double seconds) {
    ColliderPath path;
    path.keyframes = {{0, {}}, {seconds, {velocity * seconds, {1, 0, 0, 0}}}};
    return path;
}

double fastest(const Snapshot& now) {
    double out = 0;
    for (const glm::dvec3& v : now.velocities)
        out = std::max(out, glm::length(v));
    return out;
}

// Still, in place and in speed, for a second.
void judgeRest(Judge& judge, Simulation& simulation) {
    const Snapshot before = simulation.snapshot(0);
    test::runChecked(simulation, 60);
    const Snapshot now = simulation.snapshot(0);
    judge.finite(now);
    judge.atMost("m/s at rest", fastest(now), 1e-6);
    double moved = 0;
    for (size_t i = 0; i < now.positions.size(); ++i)
        moved = std::max(moved, glm::length(now.positions[i] - before.positions[i]));
    judge.atMost("m in 1 s", moved, 1e-5);
}

// m/s: of the centre of mass after a rigid body with the molecule's masses has struck a smooth plane at
// `speed` with its lowest corners, all of the same height.
double rigidRebound(const Molecule& molecule, const glm::dquat& turn, double speed, double e) {
    const double mass = analyse(molecule, false).totalMass;
    glm::dvec3 centre(0);
    double lowest = 1e9;
    for (const Vertex& vertex : molecule.vertices) {
        centre += vertex.mass / mass * (turn * vertex.position);
        lowest = std::min(lowest, (turn * vertex.position).y);
    }
    glm::dmat3 inertia(0);
    std::vector<glm::dvec3> arms;
    for (const Vertex& vertex : molecule.vertices) {
        const glm::dvec3 r = turn * vertex.position - centre;
        inertia += vertex.mass * (glm::dot(r, r) * glm::dmat3(1) - glm::outerProduct(r, r));
        if (r.y + centre.y < lowest + 1e-9) arms.push_back(r);
    }
    if (arms.size() > 1) return e * speed;  // on a face, above which the centre of mass is
    const glm::dvec3 n(0, 1, 0), across = glm::cross(arms[0], n);
    const double impulse = (1 + e) * speed / (1 / mass + glm::dot(across, glm::inverse(inertia) * across));
    return impulse / mass - speed;
}

}  // namespace

// Through a wall of 0.05 m the way of a substep is 0.83 m. All must be stopped, and leave at half their
// speed.
TEST_CASE("hard: 200 m/s at thin walls", "[hard][contact][thin]") {
    const auto shoot = [](const Solver& solver, Judge& judge, ColliderShape shape,
                          const glm::dvec3& velocity) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)  // at all phases of a step
            items.push_back(at(-0.05 * velocity + i / 16.0 * velocity / 240.0));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.groups[0].velocity = velocity;
        scene.colliders = {collider(std::move(shape), 0.5, 0)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 8);
        const Snapshot now = simulation.snapshot(0);
        int crossed = 0;
        for (size_t m = 0; m < 16; ++m) {
            crossed += glm::dot(now.positions[m], velocity) > 0;
            judge.near("speed after / before", -glm::dot(now.velocities[m], velocity) / 4e4, 0.5, 1e-3);
        }
        judge.atMost("crossed of 16", crossed, 0);
    };
    test::holds("200 m/s at a box of 0.05 m", [&](const Solver& s, Judge& judge) {
        shoot(s, judge, BoxCollider{{0, 0, 0}, {4, 0.05, 4}}, {0, -200, 0});
    });
    test::holds("200 m/s at a turned box of 0.05 m", [&](const Solver& s, Judge& judge) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, -2));
        const glm::dquat turn = glm::angleAxis(std::acos(n.y), glm::normalize(glm::cross({0, 1, 0}, n)));
        shoot(s, judge, BoxCollider{{0, 0, 0}, {4, 0.05, 4}, turn}, -200.0 * n);
    });
    test::holds("200 m/s at a capsule of 0.05 m", [&](const Solver& s, Judge& judge) {
        shoot(s, judge, CapsuleCollider{{-1, 0, 0}, {1, 0, 0}, 0.025}, {0, -200, 0});
    });
    // back and forth between two walls, 0.4 m apart, at two bounces a substep
    test::holds("200 m/s between two boxes", [](const Solver& solver, Judge& judge) {
        Scene scene = test::sceneOf(test::point(1), solver.kind, {at({0, 0, 0}), at({0, 0.05, 1})});
        scene.groups[0].velocity = {0, -200, 0};
        scene.colliders = {collider(BoxCollider{{0, 0.225, 0}, {4, 0.05, 4}}, 1, 0),
                           collider(BoxCollider{{0, -0.225, 0}, {4, 0.05, 4}}, 1, 0)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        for (int i = 0; i < 60; ++i) {
            test::runChecked(simulation, 1);
            const Snapshot now = simulation.snapshot(0);
            for (const glm::dvec3& x : now.positions)
                judge.atMost("off the middle m", x.y, 0.2);
        }
        judge.report("m/s left", fastest(simulation.snapshot(0)));
    });
}

// Onto a box, a capsule and a sphere from a height H: e^2 H.
TEST_CASE("hard: a bounce off solids", "[hard][contact][thin]") {
    const ColliderShape shapes[] = {BoxCollider{{0, -0.5, 0}, {60, 1, 60}},
                                    CapsuleCollider{{-10, -1, 0}, {60, -1, 0}, 1}};
    const char* names[] = {"box", "capsule"};
    const double h = 1 / 240.0;
    for (size_t kind = 0; kind < 2; ++kind) {
        test::holds(concat("bounce off a ", names[kind], ", restitution 0.7"), [&](const Solver& solver,
                                                                                   Judge& judge) {
            std::vector<test::Item> items;
            std::vector<double> drops;
            for (int phase = 0; phase < 16; ++phase) {
                drops.push_back(0.1 + phase / 16.0 * std::sqrt(0.2 * g) * h);
                items.push_back(at({1.5 * phase, drops.back() + thickness, 0}));
            }
            Scene scene = test::sceneOf(test::point(1), solver.kind, items);
            scene.gravity = down;
            const double lag = solver.order == 1 ? h / 2 : 0;
            scene.groups[0].velocity = {0.5, g * lag, 0};
            scene.colliders = {collider(shapes[kind], 0.7, 0.4)};
            setSteps(scene, h, 1);
            Simulation simulation = test::hardSimulation(scene);
            std::vector<double> best(16, 0), last(16, 1e9);
            std::vector<int> bounces(16, 0);
            for (int i = 0; i < 90; ++i) {
                test::runChecked(simulation, 1);
                const Snapshot now = simulation.snapshot(0);
                for (size_t m = 0; m < 16; ++m) {
                    const double v = now.velocities[m].y - g * lag;
                    bounces[m] += now.velocities[m].y > last[m] + 1e-3;
                    last[m] = now.velocities[m].y;
                    const double height = now.positions[m].y - thickness + (v > 0 ? v * v / (2 * g) : 0);
                    if (bounces[m] == 1) best[m] = std::max(best[m], height);
                }
            }
            for (size_t m = 0; m < 16; ++m)
                judge.near("ratio", best[m] / drops[m], 0.49, 0.01);
        });
    }
}

// Two planes that meet in a groove. What falls in comes to rest in it, and the planes' order does not matter.
TEST_CASE("hard: grooves", "[hard][contact]") {
    const auto fall = [](const Solver& solver, Judge& judge, double degrees, double friction) {
        const double half = degrees * std::numbers::pi / 360;
        std::vector<glm::dvec3> ends[2];
        for (const bool swapped : {false, true}) {
            Scene scene =
                test::sceneOf(test::point(1), solver.kind,
                              {at({0, 0.3, 0}), at({0.05, 0.4, 1}), at({-0.1, 0.5, 2}), at({1e-4, 0.6, 3})});
            scene.gravity = down;
            scene.colliders = {collider(plane({std::cos(half), std::sin(half), 0}), 0.3, friction),
                               collider(plane({-std::cos(half), std::sin(half), 0}), 0.3, friction)};
            if (swapped) std::swap(scene.colliders[0], scene.colliders[1]);
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::hardSimulation(scene);
            double out = 0;
            for (int i = 0; i < 300; ++i) {
                test::runChecked(simulation, 1);
                for (const glm::dvec3& x : simulation.snapshot(0).positions)
                    for (const Collider& c : scene.colliders)
                        out =
                            std::max(out, thickness - glm::dot(x, std::get<PlaneCollider>(*c.shape).normal));
            }
            judge.atMost("deepest m", out, 1e-4);
            judgeRest(judge, simulation);
            ends[swapped] = simulation.snapshot(0).positions;
        }
        for (size_t i = 0; i < ends[0].size(); ++i)
            judge.atMost("m between orders", glm::length(ends[0][i] - ends[1][i]), 1e-3);
    };
    for (const double degrees : {40.0, 90.0, 140.0})
        test::holds(concat("groove of ", degrees, " degrees"),
                    [&](const Solver& s, Judge& judge) { fall(s, judge, degrees, 0.1); });
}

// Boxes side by side, and overlapping balls: onto the seam, and sliding over it.
TEST_CASE("hard: colliders that touch or overlap", "[hard][contact][thin]") {
    test::holds("boxes side by side", [](const Solver& solver, Judge& judge) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)
            items.push_back(at({(i % 4 - 1.5) * 1e-3, 0.05 + 0.1 * (i / 4), 0.2 * (i - 8)}));
        for (int i = 0; i < 4; ++i)  // these slide across
            items.push_back(at({-0.3, thickness, 0.3 * i}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = down;
        scene.groups[0].velocity = {0.9, 0, 0};
        scene.colliders = {collider(BoxCollider{{-1, -0.5, 0}, {2, 1, 6}}, 0.2, 0.3),
                           collider(BoxCollider{{1, -0.5, 0}, {2, 1, 6}}, 0.2, 0.3)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        double lowest = 1, highest = 0;
        for (int i = 0; i < 120; ++i) {
            test::runChecked(simulation, 1);
            const Snapshot now = simulation.snapshot(0);
            for (size_t m = 0; m < now.positions.size(); ++m) {
                lowest = std::min(lowest, now.positions[m].y);
                if (m >= 16) highest = std::max(highest, now.positions[m].y);
            }
        }
        judge.near("lowest m", lowest, thickness, 1e-5);
        judge.near("highest of those that slide m", highest, thickness, 1e-5);
        judgeRest(judge, simulation);
    });
    test::holds("balls that overlap", [](const Solver& solver, Judge& judge) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)
            items.push_back(at({(i % 4 - 1.5) * 0.05, 0.8 + 0.1 * (i / 4), 0.002 * i}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = down;
        scene.colliders = {collider(SphereCollider{{-0.4, 0, 0}, 0.5}, 0.2, 1),
                           collider(SphereCollider{{0.4, 0, 0}, 0.5}, 0.2, 1)};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        double deepest = 0;
        for (int i = 0; i < 240; ++i) {
            test::runChecked(simulation, 1);
            for (const glm::dvec3& x : simulation.snapshot(0).positions)
                for (const double side : {-0.4, 0.4})
                    deepest = std::max(deepest, 0.5 - glm::length(x - glm::dvec3(side, 0, 0)));
        }
        judge.atMost("deepest m", deepest, 1e-4);
        judgeRest(judge, simulation);
    });
}

// A molecule that starts inside comes out within the time that the depth takes at 1 m/s, and is not shot out.
TEST_CASE("hard: starting inside a collider", "[hard][contact]") {
    const auto leave = [](const Solver& solver, Judge& judge, const Molecule& molecule, ColliderShape shape,
                          double limit) {
        std::vector<test::Item> items;
        for (int i = 0; i < 9; ++i)
            items.push_back(at({(i % 3 - 1) * 0.11, 0.15 + (i / 3 - 1) * 0.11, 0.03 * i}));
        items.push_back(at({0, 0, 0}));
        Scene scene = test::sceneOf(molecule, solver.kind, items);
        scene.colliders = {collider(std::move(shape), 0.9, 0.3)};
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        double speed = 0;
        for (int i = 0; i < 180; ++i) {
            test::runChecked(simulation, 1);
            speed = std::max(speed, fastest(simulation.snapshot(0)));
        }
        const Snapshot now = simulation.snapshot(0);
        judge.finite(now);
        judge.atMost("m/s on the way", speed, limit);
        double deepest = 0;
        for (const glm::dvec3& x : now.positions) {
            const bool ball = std::holds_alternative<SphereCollider>(*scene.colliders[0].shape);
            deepest = std::max(deepest, ball ? 0.5 - glm::length(x) : -x.y);
        }
        judge.atMost("m inside at the end", deepest, 1e-4);
    };
    const Molecule tetrahedron = test::tetrahedron(500, 5);
    SphereCollider ball;
    ball.radius = 0.5;
    PlaneCollider floor;
    floor.point = {0, 0, 0};
    test::holds("points inside a ball",
                [&](const Solver& s, Judge& judge) { leave(s, judge, test::point(1), ball, 1.001); });
    test::holds("tetrahedra inside a ball",
                [&](const Solver& s, Judge& judge) { leave(s, judge, tetrahedron, ball, 4); });
    test::holds("tetrahedra inside the ground",
                [&](const Solver& s, Judge& judge) { leave(s, judge, tetrahedron, floor, 1); });
}

// A floor that moves carries; a paddle gives (1 + e) of its speed; a wall that passes 60 times a second hits.
TEST_CASE("hard: colliders that move", "[hard][contact][moving]") {
    const auto carry = [](const Solver& solver, Judge& judge, const glm::dvec3& velocity, double behind) {
        Scene scene =
            test::sceneOf(test::point(1), solver.kind, {at({0, thickness, 0}), at({1, 0.2 + thickness, 0})});
        scene.gravity = down;
        scene.colliders = {collider(PlaneCollider{}, 0.2, 0.5)};
        scene.colliders[0].path = ride(velocity, 10);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 120);
        const Snapshot before = simulation.snapshot(0);
        test::runChecked(simulation, 60);
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < 2; ++m) {
            judge.atMost("off the floor's m/s", glm::length(now.velocities[m] - velocity), 1e-5);
            judge.atMost("off the floor's way m",
                         glm::length(now.positions[m] - before.positions[m] - velocity), 1e-4);
            judge.near("off the floor m", now.positions[m].y - velocity.y * 3, thickness, 1e-5);
        }
        judge.near("slid m", velocity.x * 3 - now.positions[0].x, behind, 0.02 * behind + 1e-6);
    };
    // it slides until friction has given it the speed: v^2 / 2 mu g behind
    test::holds("a floor that carries", [&](const Solver& s, Judge& judge) {
        carry(s, judge, {1.5, 0, 0}, 1.5 * 1.5 / g);
    });
    test::holds("a lift", [&](const Solver& s, Judge& judge) { carry(s, judge, {0, 0.4, 0}, 0); });
    test::holds("a paddle", [](const Solver& solver, Judge& judge) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)
            items.push_back(at({0.5 + i / 16.0 * 3 / 240, 0, 0.2 * i - 1.5}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.colliders = {collider(BoxCollider{{0, 0, 0}, {0.05, 1, 8}}, 0.6, 0.5)};
        scene.colliders[0].path = ride({3, 0, 0}, 0.4);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 60);
        for (const glm::dvec3& v : simulation.snapshot(0).velocities)
            judge.near("m/s after", glm::length(v), 1.6 * 3, 0.01);
    });
    test::holds("a fast thin paddle", [](const Solver& solver, Judge& judge) {
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)
            items.push_back(at({5 + i / 16.0 * 100 / 240, 0, 0.2 * i - 1.5}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.colliders = {collider(BoxCollider{{0, 0, 0}, {0.05, 1, 8}}, 0, 0.5)};
        scene.colliders[0].path = ride({100, 0, 0}, 0.4);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 12);
        for (const glm::dvec3& v : simulation.snapshot(0).velocities)
            judge.near("m/s after", v.x, 100, 0.1);
    });
    test::holds("a turntable", [](const Solver& solver, Judge& judge) {
        Scene scene =
            test::sceneOf(test::point(1), solver.kind, {at({0.3, thickness, 0}), at({0, thickness, -0.5})});
        scene.gravity = down;
        scene.colliders = {collider(BoxCollider{{0, -0.1, 0}, {4, 0.2, 4}}, 0.2, 1)};
        ColliderPath path;
        path.repeats = true;
        for (int i = 0; i <= 4; ++i)
            path.keyframes.push_back(
                {i / 2.0, {{0, 0, 0}, glm::angleAxis(i * std::numbers::pi / 2, glm::dvec3(0, 1, 0))}});
        scene.colliders[0].path = path;
        setSteps(scene, 1 / 60.0, 4);
        scene.groups[0].spin = {};
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 60);
        const Snapshot before = simulation.snapshot(0);
        test::runChecked(simulation, 120);  // once round
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < 2; ++m) {
            const double r = glm::length(glm::dvec2(now.positions[m].x, now.positions[m].z));
            judge.near("speed / w r", glm::length(now.velocities[m]) / (r * std::numbers::pi), 1, 0.01);
            judge.near("drift outwards m a turn",
                       r - glm::length(glm::dvec2(before.positions[m].x, before.positions[m].z)), 0,
                       solver.order == 1 ? 0.03 : 0.002);
        }
    });
}

// A tetrahedron so stiff that it is a body thrown at a plane at 2 m/s, without gravity: against the impact of
// a rigid body, whose impulse at a corner is (1 + e) v / (1/M + n . (I^-1 (r x n)) x r).
TEST_CASE("hard: impact of a stiff body", "[hard][contact][body]") {
    const auto strike = [](const Solver& solver, Judge& judge, bool onCorner) {
        for (const double stiffness : {1e6, 1e8}) {
            for (const double e : {0.5, 1.0}) {
                const glm::dquat turn = onCorner
                                            ? glm::angleAxis(2.2, glm::normalize(glm::dvec3(1, 0.3, 0.5)))
                                            : glm::dquat(1, 0, 0, 0);
                const Molecule molecule = test::tetrahedron(stiffness, 0);
                std::vector<test::Item> items;
                double lowest = 1e9;
                for (const Vertex& vertex : molecule.vertices)
                    lowest = std::min(lowest, (turn * vertex.position).y);
                for (int i = 0; i < 8; ++i)
                    items.push_back(
                        at({2.0 * i, thickness - lowest + 0.05 + (i + 0.5) / 8 * 2 / 240, 0}, turn));
                Scene scene = test::sceneOf(molecule, solver.kind, items);
                scene.groups[0].velocity = {0, -2, 0};
                scene.colliders = {collider(PlaneCollider{}, e, 0)};
                setSteps(scene, 1 / 240.0, 1);
                Simulation simulation = test::hardSimulation(scene);
                std::vector<int> since(8, 0);  // steps
                const double rigid = rigidRebound(molecule, turn, 2, e);
                for (int step = 0; step < 16; ++step) {
                    test::runChecked(simulation, 1);
                    const Snapshot now = simulation.snapshot(0);
                    for (int m = 0; m < 8; ++m) {
                        const glm::dvec3 momentum =
                            reference::momentum({.molecule = &molecule}, test::stateOf(now, m));
                        const double v = momentum.y / analyse(molecule, false).totalMass;
                        if (v > -1.99) ++since[size_t(m)];
                        if (since[size_t(m)] == 2)  // before another corner comes down
                            judge.near(concat("off the rigid body's / 2 m/s, e ", e), (v - rigid) / 2, 0,
                                       1e-3);
                    }
                }
                judge.atMost("missed", double(std::count(since.begin(), since.end(), 0)), 0);
            }
        }
    };
    // dropped on a corner from 5 cm, it topples onto a face and lies still, on the flat and where friction
    // holds it
    test::holds("stiff body, at rest", [](const Solver& solver, Judge& judge) {
        for (const double degrees : {0.0, 15.0}) {
            const double a = degrees * std::numbers::pi / 180;
            std::vector<test::Item> items;
            for (int i = 0; i < 8; ++i)
                items.push_back(at({1.5 * (i - 4), 0.6 - 1.5 * (i - 4) * std::tan(a), 0},
                                   glm::angleAxis(0.7 * i, glm::normalize(glm::dvec3(1, 0.2 * i, 0.5)))));
            Scene scene = test::sceneOf(test::tetrahedron(1e6, 0), solver.kind, items);
            scene.gravity = down;
            scene.colliders = {collider(plane({std::sin(a), std::cos(a), 0}), 0.2, 0.6)};
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::hardSimulation(scene);
            test::runChecked(simulation, 240);
            const Snapshot before = simulation.snapshot(0);
            judge.atMost("m/s after 4 s", fastest(before), 1e-3);
            test::runChecked(simulation, 120);
            const Snapshot now = simulation.snapshot(0);
            double moved = 0;
            for (size_t i = 0; i < now.positions.size(); ++i)
                moved = std::max(moved, glm::length(now.positions[i] - before.positions[i]));
            judge.atMost("m in 2 s", moved, 1e-3);
        }
    });
    test::holds("stiff body, flat", [&](const Solver& s, Judge& judge) { strike(s, judge, false); });
    test::holds("stiff body, on a corner", [&](const Solver& s, Judge& judge) { strike(s, judge, true); });
}

}  // namespace shoal
