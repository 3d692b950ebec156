// One spring between two masses against the closed form and against the method's own recurrence in double.
#include <algorithm>
#include <cmath>

#include "hard/outcome.h"
#include "reference/discrete.h"
#include "support/catch.h"
#include "support/every_kind.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

constexpr double stiffness = 80, first = 1, second = 0.5, reduced = first * second / (first + second);

// The spring's length: l(t) = 1 + e^-dt (A cos wt + B sin wt), d = c / 2m, w^2 = k/m - d^2, m the reduced
// mass; l(0) = 1 + stretch, l'(0) = speed.
struct Motion {
    double stretch = 0, speed = 0, damping = 0;
    double lengthAt(double t) const {
        const double d = damping / (2 * reduced), w = std::sqrt(stiffness / reduced - d * d);
        return 1 +
               std::exp(-d * t) * (stretch * std::cos(w * t) + (speed + d * stretch) / w * std::sin(w * t));
    }
};

// RMS over 30 frames in 1 s, about 2.5 periods, of the length's error.
double pathError(const Solver& solver, const Motion& motion, int substeps) {
    Molecule molecule = test::pair(first, second, stiffness, motion.damping);
    molecule.vertices[1].position.x = 1 + motion.stretch;
    molecule.springs[0].restLength = 1;
    Scene scene = test::sceneOf(molecule, solver.kind);
    setSteps(scene, 1 / 30.0, substeps);
    Simulation simulation = test::hardSimulation(scene);
    test::startFrom(simulation, [&](GroupState& start) { start.velocities[1].x = float(motion.speed); });
    double sum = 0;
    for (int i = 1; i <= 30; ++i) {
        simulation.frame();
        const Snapshot now = simulation.snapshot(0);
        const double error = now.positions[1].x - now.positions[0].x - motion.lengthAt(now.time);
        sum += error * error / 30;
    }
    return std::sqrt(sum);
}

// Substeps of a frame of 1/30 s with w h well below 1 and the error well above float's floor, which is 2e-6
// (6e-8 m a rounding; verlet's velocity adds up to 2e-4 at these steps).
int coarseSteps(const Solver& solver) {
    return solver.order == 1 ? 16 : solver.order == 2 ? 8 : 1;
}

struct Slope {
    double order = 0, error = 0;
};

Slope slopeOf(const Solver& solver, const Motion& motion) {
    const int steps = coarseSteps(solver);
    const double coarse = pathError(solver, motion, steps), fine = pathError(solver, motion, 2 * steps);
    return {std::log2(coarse / fine), fine};
}

}  // namespace

// The spring has no force in the first moment. The first-order error of euler shifts the phase by h/2, which
// does not show in the length, a sine. So the order is at least that of the table.
TEST_CASE("hard: a spring kicked at rest length", "[hard][springs]") {
    test::holds("harmonic spring, kicked", [&](const Solver& solver, Judge& judge) {
        const Slope slope = slopeOf(solver, {.speed = 1.5});
        judge.near("order", slope.order, std::max<double>(solver.order, slope.order), 0.15);
        judge.report("error", slope.error);
    });
}

// A force from the first moment on, which a method that goes on from its last step does not know of. The
// slope on halving is the table's order +-0.15: what is left of the next order at these steps.
TEST_CASE("hard: a spring let go stretched", "[hard][springs]") {
    for (double damping : {0.0, 0.5}) {
        test::holds(damping > 0 ? "damped spring" : "harmonic spring",
                    [&](const Solver& solver, Judge& judge) {
                        const Slope slope = slopeOf(solver, {.stretch = 0.1, .damping = damping});
                        judge.near("order", slope.order, solver.order, 0.15);
                        judge.report("error", slope.error);
                    });
    }
}

TEST_CASE("hard: the discrete recurrence", "[hard][springs]") {
    test::holds("discrete recurrence", [](const Solver& solver, Judge& judge) {
        Scene scene = test::sceneOf(test::leaf(400, 2), solver.kind, {at({1, 2, 3}, test::turned())});
        scene.gravity = {0.5, -9.81, 0};
        scene.groups[0].drag = {1.5, 1.5};
        scene.groups[0].spin = {0.5, 2, -1};
        scene.fields.push_back(test::field(test::shear()));
        setSteps(scene, 0.5, 120);
        Simulation simulation = test::hardSimulation(scene);
        reference::State expected = test::stateOf(simulation.snapshot(0), 0);
        test::runChecked(simulation, 1);
        reference::frame(test::problemOf(scene, 0), expected, solver.kind, 0.5, 120);
        // 120 roundings of 6e-8 m and of 5e-7 m/s over half a second, amplified by the springs a few times
        judge.atMost("apart", reference::relativeError(test::stateOf(simulation.snapshot(0), 0), expected, 1),
                     5e-6);
    });
}

}  // namespace shoal
