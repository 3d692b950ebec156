// Many leaves in the wind against the double reference: orders, repeatability, drag, and pins that are
// released.
#include <algorithm>
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

// 64 leaves of different sizes and turns, the first vertex of each pinned or all free, in gust, curl noise,
// shear.
Scene leavesInWind(SolverKind kind, const Drag& drag, bool pinned) {
    std::vector<test::Item> items;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 0.1 * i - 3, 2 - 0.05 * i));
        items.push_back(at({i % 4 * 2.5 - 5, i / 4 % 4 * 2.5, i / 16 * 2.5 - 4},
                           glm::angleAxis(0.37 * i, axis), 0.8 + 0.01 * i));
    }
    Molecule molecule = test::leaf(150, 1);
    molecule.vertices[0].pinned = pinned;
    Scene scene = test::sceneOf(molecule, kind, items);
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].drag = drag;
    GustField gust;
    gust.direction = {2, 0.2, -1};
    gust.seed = 4;
    CurlNoiseField noise;
    noise.octaves = 2;
    noise.seed = 8;
    gust.noise = noise.noise = NoiseForm::computed;  // a GPU's filter of tables would hide the order
    scene.fields = {test::field(gust), test::field(noise), test::field(test::shear())};
    scene.fields[1].weight = 0.7;
    return scene;
}

struct Errors {
    double total = 0, centroid = 0, shape = 0, worst = 0;
};

// RMS over the leaves of the relative errors after 1 s.
Errors errorsOf(Scene scene, int substeps, const std::vector<reference::State>& exact) {
    setSteps(scene, 1 / 30.0, substeps);
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 30);
    const Snapshot now = simulation.snapshot(0);
    Errors out;
    for (int m = 0; m < now.count; ++m) {
        const auto d =
            reference::deviation(test::stateOf(now, m), exact[size_t(m)], scene.groups[0].molecule.size());
        out.total += d.total * d.total / now.count;
        out.centroid += d.centroid * d.centroid / now.count;
        out.shape += d.shape * d.shape / now.count;
        out.worst = std::max(out.worst, d.total);
    }
    out.total = std::sqrt(out.total), out.centroid = std::sqrt(out.centroid),
    out.shape = std::sqrt(out.shape);
    return out;
}

std::vector<reference::State> exactStates(Scene scene) {
    setSteps(scene, 1 / 30.0, 64);
    const Snapshot start = test::simulationOf(scene).snapshot(0);
    std::vector<reference::State> out;
    for (int m = 0; m < start.count; ++m) {
        const auto solution = reference::solve(test::problemOf(scene, m), test::stateOf(start, m), 1, 1e-6);
        REQUIRE(solution.converged);
        out.push_back(solution.state);
    }
    return out;
}

}  // namespace

TEST_CASE("leaves in gust, curl noise and shear: orders 1 and 2 against the reference", "[numerics]") {
    for (bool pinned : {false, true}) {
        const Drag drag = pinned ? Drag{3, 0.8} : Drag{1.2, 1.2};
        const auto exact = exactStates(leavesInWind(SolverKind::leapfrog, drag, pinned));
        for (SolverKind kind : bothSolvers) {
            const Scene scene = leavesInWind(kind, drag, pinned);
            const int steps = kind == SolverKind::euler ? 64 : 3;
            const Errors coarse = errorsOf(scene, steps, exact), fine = errorsOf(scene, 2 * steps, exact);
            const double order = std::log2(coarse.total / fine.total);
            UNSCOPED_INFO(name(kind) << (pinned ? " pinned" : " free") << ": order " << order << ", error "
                                     << fine.total << " (centroid " << fine.centroid << ", shape "
                                     << fine.shape << ", worst leaf " << fine.worst << ") at h = 1/"
                                     << 60 * steps);
            // Float's floor is about 1e-5 after 1 s (6e-8 a rounding, grown by the motion): the errors that
            // give the slope stay an order of magnitude above it.
            CHECK(fine.total > 1e-5);
            CHECK(fine.total < 0.02);
            CHECK(order == Approx(test::orderOf(kind)).margin(0.15));
        }
    }
}

TEST_CASE("directional drag with equal rates is plain drag to rounding", "[numerics]") {
    for (SolverKind kind : bothSolvers) {
        Snapshot ends[2];
        for (int i = 0; i < 2; ++i) {
            Scene scene = leavesInWind(kind, {2, i == 0 ? 2.0 : 2 * (1 + 1e-12)}, false);
            setSteps(scene, 1 / 60.0, 8);
            const Plan plan = compile(scene);
            REQUIRE(plan.groups[0].needs.directionalDrag == (i == 1));
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 30);
            ends[i] = simulation.snapshot(0);
        }
        double worst = 0;
        for (size_t i = 0; i < ends[0].positions.size(); ++i) {
            worst = std::max(worst, glm::length(ends[0].positions[i] - ends[1].positions[i]));
        }
        INFO(name(kind) << " apart by " << worst);
        CHECK(worst < 2e-5);  // roundings of 240 steps in other places
    }
}

TEST_CASE("the same seed gives the same bits, another seed gives others", "[numerics]") {
    for (SolverKind kind : bothSolvers) {
        Scene scene = leavesInWind(kind, {3, 1}, true);
        Placement& place = scene.groups[0].place;
        place.turn = Placement::Turn::any;
        scene.groups[0].release = Release{{}, 2.0, 0};
        Simulation simulation = test::simulationOf(scene);
        run(simulation, 20);
        const uint64_t first = simulation.hash();
        simulation.restart();
        CHECK(simulation.hash() != first);
        run(simulation, 20);
        CHECK(simulation.hash() == first);
        Simulation again = test::simulationOf(scene);
        run(again, 20);
        CHECK(again.hash() == first);
        scene.seed = 2;
        Simulation other = test::simulationOf(scene);
        run(other, 20);
        CHECK(other.hash() != first);
    }
}

TEST_CASE("every molecule of a group moves alike wherever it is stored", "[numerics]") {
    const std::vector<test::Item> items(1030, at({0, 0.8, 0}, test::turned()));
    for (SolverKind kind : bothSolvers) {
        Scene scene = test::sceneOf(test::leaf(200, 1), kind, items);
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].drag = {5, 1};
        scene.groups[0].spin = {1, 2, 3};
        PlaneCollider ground;
        scene.colliders.push_back({});
        scene.colliders[0].shape = ground;
        setSteps(scene, 1 / 15.0, 24);
        Simulation simulation = test::simulationOf(scene, true);
        run(simulation, 5);
        const Snapshot now = simulation.snapshot(0);
        REQUIRE(now.positions.size() == 4120);
        bool same = true;
        for (size_t i = 4; i < now.positions.size(); ++i) {
            same &= now.positions[i] == now.positions[i % 4] && now.velocities[i] == now.velocities[i % 4] &&
                    now.normals[i] == now.normals[i % 4];
        }
        CHECK(same);
        CHECK(now.positions[0] != glm::dvec3(0));
    }
}

TEST_CASE("a pin lets go above a force and not below", "[numerics]") {
    // a weight on a spring, at rest: the spring pulls the pin with m g
    Molecule molecule = test::pair(1, 2, 500, 0);
    molecule.vertices[0].pinned = true;
    const double pull = 2 * 9.81;
    molecule.springs[0].restLength = 1 - pull / 500;
    const glm::dquat hanging = glm::angleAxis(-std::acos(0.0), glm::dvec3(0, 0, 1));  // +x to -y
    for (SolverKind kind : bothSolvers) {
        for (double share : {0.95, 1.05}) {
            for (double after : {0.0, 0.49}) {
                Scene scene = test::sceneOf(molecule, kind, {at({0, 3, 0}, hanging)});
                scene.gravity = {0, -9.81, 0};
                scene.groups[0].release = Release{share * pull, {}, after};
                setSteps(scene, 1 / 60.0, 4);
                Simulation simulation = test::simulationOf(scene);
                run(simulation, 20);
                CHECK(simulation.snapshot(0).released[0] == (share < 1 && after == 0));
                run(simulation, 40);
                const Snapshot now = simulation.snapshot(0);
                INFO(name(kind) << " share " << share << " after " << after);
                CHECK(now.released[0] == (share < 1));
                const double fallen = 3 - now.positions[0].y;
                if (share > 1) {
                    CHECK(fallen == 0);
                } else {
                    // the centre of mass falls freely from then on
                    const double t = after == 0 ? 1 : 0.5, start = 3 - 2.0 / 3;
                    const double middle = (now.positions[0].y + 2 * now.positions[1].y) / 3;
                    CHECK(middle == Approx(start - 9.81 * t * t / 2).margin(0.5 * 9.81 * t / 240 + 1e-3));
                }
            }
        }
    }
}

// Two weights hang from two pins, the heavy one from the first or from the last.
TEST_CASE("the strongest pull on a pin lets all of them go", "[numerics]") {
    for (const bool heavyFirst : {true, false}) {
        for (const double limit : {15.0, 25.0}) {
            Molecule molecule;
            molecule.name = "weights";
            for (int i = 0; i < 2; ++i) {
                const double mass = heavyFirst == (i == 0) ? 2 : 0.5, k = 500;
                molecule.vertices.push_back({.position = {i, 3, 0}, .mass = 1, .pinned = true});
                molecule.vertices.push_back({.position = {i, 2, 0}, .mass = mass});
                molecule.springs.push_back({2 * i, 2 * i + 1, k, 0, 1 - mass * 9.81 / k, {}});
            }
            Scene scene = test::sceneOf(molecule, SolverKind::leapfrog);
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].release = Release{limit, {}, 0};
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::simulationOf(scene);
            run(simulation, 2);
            CAPTURE(heavyFirst, limit);
            CHECK(simulation.snapshot(0).released[0] == (limit < 2 * 9.81));
        }
    }
}

TEST_CASE("pins let go at their rate", "[numerics]") {
    Molecule molecule = test::pair(1, 1, 100, 0);
    molecule.vertices[0].pinned = true;
    const int count = 4096;
    const double rate = 1.5, after = 0.25;
    Scene scene = test::sceneOf(molecule, SolverKind::leapfrog, std::vector<test::Item>(size_t(count)));
    scene.groups[0].release = Release{{}, rate, after};
    Simulation simulation = test::simulationOf(scene);
    std::vector<bool> before(size_t(count), false);
    for (int i = 1; i <= 90; ++i) {
        simulation.frame();
        if (i % 15 != 0) continue;
        const Snapshot now = simulation.snapshot(0);
        // frames that start at or after `after` have drawn lots
        const double share = -std::expm1(-rate * std::max(0.0, now.time - after));
        const double deviation = std::sqrt(count * share * (1 - share));
        const auto released = std::count(now.released.begin(), now.released.end(), true);
        INFO("t " << now.time << " released " << released << " expected " << count * share);
        CHECK(std::abs(double(released) - count * share) <= 4 * deviation + 1e-9);
        for (size_t m = 0; m < size_t(count); ++m)
            CHECK((!before[m] || now.released[m]));  // for good
        before = now.released;
    }
}

}  // namespace shoal
