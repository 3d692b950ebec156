// Points without springs: gravity, drag, fields.
#include <algorithm>
#include <cmath>

#include "hard/outcome.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using test::Judge;
using test::run;
using test::setSteps;

namespace {

const glm::dvec3 gravity{0, -9.81, 0};

// 16 points about the origin, dragged towards a field.
Scene carried(const Solver& solver, FieldShape shape, double rate) {
    std::vector<test::Item> items;
    for (int i = 0; i < 16; ++i)
        items.push_back(at({0.5 + 0.37 * (i % 4), 0.4 + 0.41 * (i / 4), 0}));
    Scene scene = test::sceneOf(test::point(1), solver.kind, items);
    scene.groups[0].drag = {rate, rate};
    scene.fields.push_back(test::field(std::move(shape)));
    return scene;
}

// RMS distance of the points in m from the reference's after 1 s.
double carriedError(Scene scene, int substeps, const std::vector<reference::State>& exact) {
    setSteps(scene, 1 / 10.0, substeps);
    Simulation simulation = test::hardSimulation(scene);
    test::runChecked(simulation, 10);
    const Snapshot now = simulation.snapshot(0);
    double sum = 0;
    for (size_t m = 0; m < exact.size(); ++m) {
        const glm::dvec3 off = now.positions[m] - exact[m].position[0];
        sum += glm::dot(off, off) / double(exact.size());
    }
    return std::sqrt(sum);
}

}  // namespace

// x = x0 + v t + g t^2/2; a method of order 1 that moves by the velocity at the step's end is off by g h t/2.
TEST_CASE("hard: free fall", "[hard][motion]") {
    test::holds("free fall", [](const Solver& solver, Judge& judge) {
        const glm::dvec3 velocity{1, 4, 2};
        const double h = 1 / 240.0;
        Scene scene = test::sceneOf(test::point(0.3), solver.kind, {at({0.3, 5, -2})});
        scene.gravity = gravity;
        scene.groups[0].velocity = velocity;
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        const glm::dvec3 start = simulation.snapshot(0).positions[0];
        test::runChecked(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        const double t = now.time;
        const glm::dvec3 offset = now.positions[0] - (start + velocity * t + 0.5 * gravity * t * t);
        const glm::dvec3 expected = solver.order == 1 ? 0.5 * gravity * h * t : glm::dvec3(0);
        // 480 velocity roundings of 5e-7 m/s at 16 m/s, if they all went one way for 1 s on average: 2e-4
        judge.atMost("off by m", glm::length(offset - expected), 1e-4);
        judge.atMost("m/s", glm::length(now.velocities[0] - (velocity + gravity * t)), 1e-4);
    });
}

// No force at all: the velocity keeps its bits and x = x0 + v t, a rounding of 6e-8 m a step.
TEST_CASE("hard: a single vertex without springs", "[hard][motion]") {
    test::holds("single vertex, ballistic", [](const Solver& solver, Judge& judge) {
        const glm::dvec3 velocity{1, -0.75, 0.3};
        Scene scene = test::sceneOf(test::point(1e-3), solver.kind);
        scene.groups[0].velocity = velocity;
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        const Snapshot start = simulation.snapshot(0);
        test::runChecked(simulation, 120);
        const Snapshot now = simulation.snapshot(0);
        judge.atMost("m/s", glm::length(now.velocities[0] - start.velocities[0]), 0);
        // 480 roundings of 6e-8 m within 1 m of the anchor, if they all went one way
        judge.atMost("off by m",
                     glm::length(now.positions[0] - start.positions[0] - start.velocities[0] * now.time),
                     480 * 6e-8);
    });
}

// dv/dt = g + gamma (u - v) ends at v = u + g / gamma, whatever gamma h.
TEST_CASE("hard: Stokes terminal velocity", "[hard][motion]") {
    const auto settle = [](const Solver& solver, Judge& judge, double from, double to) {
        const glm::dvec3 wind{2, 0.5, -1};
        const double h = 1 / 240.0;
        for (double product = from; product <= to; product *= 10) {
            Scene scene = test::sceneOf(test::point(1), solver.kind);
            scene.gravity = gravity;
            scene.fields.push_back(test::field(UniformField{wind}));
            scene.groups[0].drag = {product / h, product / h};
            setSteps(scene, 240 * h, 240);
            Simulation simulation = test::hardSimulation(scene);
            // from rest, until e^-13 = 2e-6 of the difference is left; at gamma h = 1e-3 in 55 frames of a
            // second
            test::runChecked(simulation, std::max(1, int(std::ceil(13 / (240 * product)))));
            const glm::dvec3 terminal = wind + gravity * h / product;
            const glm::dvec3 off = simulation.snapshot(0).velocities[0] - terminal;
            // A velocity stops when its change in a step is less than half a rounding: 6e-8 v / (gamma h).
            // With history two are added up; verlet's is a difference of positions, which are rounded by 6e-8
            // m.
            const double speed = glm::length(terminal);
            const double roundings = (solver.history ? 2 : 1) +
                                     (solver.kind == SolverKind::verlet ? 1 / (h * speed) : 0) +
                                     test::divided(solver, 1) / 6e-8;
            judge.atMost("off", glm::length(off) / speed, 1e-5 + roundings * 6e-8 / product);
        }
    };
    test::holds("terminal velocity, gamma h 0.001 to 1",
                [&](const Solver& s, Judge& judge) { settle(s, judge, 1e-3, 1.5); });
    test::holds("terminal velocity, gamma h 10 to 1e5",
                [&](const Solver& s, Judge& judge) { settle(s, judge, 10, 1.5e5); });
}

// Arnold-Beltrami-Childress: dv/dt = 5 /s (u - v) against the double reference; slope on halving = order
// +-0.15.
TEST_CASE("hard: ABC advection", "[hard][motion]") {
    test::holds("ABC advection", [](const Solver& solver, Judge& judge) {
        AbcField field;
        field.wavelength = 4;
        const Scene scene = carried(solver, field, 5);
        std::vector<reference::State> exact;
        const Snapshot start = test::hardSimulation(scene).snapshot(0);
        for (int m = 0; m < start.count; ++m)
            exact.push_back(
                reference::solve(test::problemOf(scene, m), test::stateOf(start, m), 1, 1e-9).state);
        // h of 0.0125 s and half of it, errors of 5e-3 m to 1e-5; rk4 with 0.1 s, before float's floor of
        // 1e-6 m
        const int steps = solver.order == 4 ? 1 : 8;
        const double coarse = carriedError(scene, steps, exact), fine = carriedError(scene, 2 * steps, exact);
        // the finer error may be off by the floor, and the order by the logarithm's slope times that
        judge.near("order", std::log2(coarse / fine), solver.order, 0.15 + 1e-6 / fine / std::log(2));
        judge.report("error", fine);
    });
}

// A fluid's particle keeps the stream function cos kx cos ky of Taylor-Green's vortices. One of drag rate
// gamma leaves by its inertia, at (u.grad u).grad psi / gamma; a step of h that goes straight on by (u.grad
// u).grad psi h/2. Both factors are at most U k^2 U = 1 here, so that psi drifts by at most t (1/gamma +
// h/2).
TEST_CASE("hard: Taylor-Green advection", "[hard][motion]") {
    test::holds("Taylor-Green stream function", [](const Solver& solver, Judge& judge) {
        const double rate = 600, seconds = 10, h = 1 / 240.0;
        Scene scene = carried(solver, TaylorGreenField{}, rate);
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        const Snapshot start = simulation.snapshot(0);
        test::runChecked(simulation, int(60 * seconds));
        const Snapshot now = simulation.snapshot(0);
        const auto psi = [](const glm::dvec3& x) { return std::cos(x.x) * std::cos(x.y); };
        for (size_t m = 0; m < now.positions.size(); ++m)
            judge.atMost("drift", psi(now.positions[m]) - psi(start.positions[m]),
                         seconds * (1 / rate + (solver.order == 1 ? h / 2 : 0)));
    });
}

}  // namespace shoal
