// Long runs, steps far beyond the springs' period, masses far apart, a frame that takes too long.
#include <algorithm>
#include <cmath>

#include "hard/outcome.h"
#include "reference/discrete.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

// A leaf's highest frequency at stiffness 1 and masses of 1: what a scene's stiffness is scaled by.
double frequencyOf(const Scene& scene) {
    Scene other = scene;
    other.solver.kind = SolverKind::bdf2Xpbd;  // refuses no step
    return compile(other).groups[0].highestFrequency;
}

Molecule stretchedPair() {
    Molecule molecule = test::pair(1, 0.5, 1, 0);
    molecule.vertices[1].position.x = 1.1;
    molecule.springs[0].restLength = 1;
    return molecule;
}

// A molecule whose vertices take one another's places under a half turn or a mirror, stretched along x in the
// same way.
struct Symmetric {
    Molecule molecule;
    std::vector<size_t> image;  // of each vertex
    glm::dvec3 signs;           // of its coordinates
};

Symmetric squareOf(double stiffness, double damping) {
    return {test::leaf(stiffness, damping), {2, 3, 0, 1}, {-1, 1, -1}};
}

// Three springs, of which no two are independent.
Symmetric triangleOf(double stiffness, double damping) {
    Molecule out = test::leaf(stiffness, damping);
    out.vertices.resize(3);
    const glm::dvec3 corners[] = {{-0.5, 0, 0.25}, {0.5, 0, 0.25}, {0, 0, -0.5}};
    for (size_t i = 0; i < 3; ++i)
        out.vertices[i].position = corners[i];
    std::erase_if(out.springs, [](const Spring& spring) { return spring.b == 3; });
    out.triangles = {{0, 1, 2}};
    return {out, {1, 0, 2}, {-1, 1, 1}};
}

}  // namespace

// The energy k a^2 / 2 of an undamped spring stays. Symplectic methods keep it within w h / 2 for ever; rk4
// loses (w h)^6 / 72 a step, 2e-4 in all at w h = 0.05. The double recurrence of the same method says what
// float adds.
// [fused]: the ping-pong path takes 0.1 ms a step, which is minutes.
TEST_CASE("hard: a million steps undamped", "[hard][stiff][fused]") {
    test::holds("a million steps, undamped", [](const Solver& solver, Judge& judge) {
        const int frames = 1000, substeps = 1000;
        const double h = 1 / 60000.0, product = 0.05;
        Scene scene = test::sceneOf(stretchedPair(), solver.kind);
        const double w = frequencyOf(scene);
        scene.groups[0].stiffness = product * product / (h * h * w * w);
        setSteps(scene, h * substeps, substeps);
        Simulation simulation = test::hardSimulation(scene);
        const reference::Problem problem = test::problemOf(scene, 0);
        reference::State state = test::stateOf(simulation.snapshot(0), 0);
        const double before = reference::energy(problem, state);
        double after = before;
        for (int i = 0; i < frames && after > 0.5 * before; i += 100) {  // half of it lost is enough to know
            test::runChecked(simulation, 100);
            after = reference::energy(problem, test::stateOf(simulation.snapshot(0), 0));
        }
        // where in its period the last step ends matters to a method of order 1: w h / 2 = 2.5 % of the
        // energy
        judge.atMost("energy drift", after / before - 1, solver.order == 1 ? product / 2 : 5e-3);
        if (solver.implicit) return;  // damped away: there is nothing to compare
        reference::frame(problem, state, solver.kind, h * substeps * frames, frames * substeps);
        judge.atMost("float - double", (after - reference::energy(problem, state)) / before,
                     5e-3 + 2 * test::divided(solver, frames * substeps));
    });
}

// Leaves that turn, fly and start 10 % too large, with some damping: after 5 s they are finite, whole (rms
// strain below 0.3) and no faster than they were.
TEST_CASE("hard: steps beyond the springs' period", "[hard][stiff]") {
    const auto strain = [](const Solver& solver, Judge& judge, double from, double to) {
        for (double product = from; product <= to; product *= std::sqrt(10)) {
            const double h = 1 / 240.0;
            Scene scene = test::sceneOf(test::leaf(1, 0.02), solver.kind, {at({0, 0, 0}, test::turned())});
            const double w = frequencyOf(scene), needed = product * product / (h * h * w * w);
            scene.groups[0].stiffness = needed;
            scene.groups[0].damping = std::sqrt(needed);
            scene.groups[0].velocity = {1, 2, 3};
            scene.groups[0].spin = {3, 1, -2};
            setSteps(scene, 1 / 60.0, 4);
            Simulation simulation = test::hardSimulation(scene);
            test::startFrom(simulation,
                            [](GroupState& start) { test::scaleMolecules(start, glm::dvec3(1.1)); });
            const reference::Problem problem = test::problemOf(scene, 0);
            const double before = reference::energy(problem, test::stateOf(simulation.snapshot(0), 0));
            test::runChecked(simulation, 300);
            const reference::State end = test::stateOf(simulation.snapshot(0), 0);
            judge.atMost("strain", test::strainOf(scene.groups[0].molecule, end), 0.3);
            judge.atMost("energy / first", reference::energy(problem, end) / before, 1);
        }
    };
    test::holds("w h 0.1 to 1", [&](const Solver& s, Judge& judge) { strain(s, judge, 0.1, 1.1); });
    test::holds("w h 10 to 1000", [&](const Solver& s, Judge& judge) { strain(s, judge, 10, 1001); });
}

// A tetrahedron one of whose corners has a millionth of the others' mass, 1 % too large at the start. Its
// heavy modes are damped at 1.5 /s and more, its light ones (of damping ratio 0.005) at 25 /s: at most e^-7.5
// of the stretch, 5e-6, is left after 5 s. Float adds its part: a vertex moves only while v h is half a
// rounding of x, so that at 3000 steps a second it stops at 1e-4 m/s, c v / k L = 7e-6 short of its place.
TEST_CASE("hard: mass ratio 1e6", "[hard][stiff]") {
    const auto settle = [](const Solver& solver, Judge& judge, int substeps) {
        Molecule molecule = test::tetrahedron(10, 3);
        molecule.vertices[2].mass = 1e-6;
        for (Spring& spring : molecule.springs)
            if (spring.a == 2 || spring.b == 2) spring.damping = 3e-5;
        Scene scene = test::sceneOf(molecule, solver.kind, {at({0, 0, 0}, test::turned())});
        setSteps(scene, 1 / 60.0, substeps);
        Simulation simulation = test::hardSimulation(scene);
        test::startFrom(simulation, [](GroupState& start) { test::scaleMolecules(start, glm::dvec3(1.01)); });
        test::runChecked(simulation, 300);
        judge.atMost("strain", test::strainOf(molecule, test::stateOf(simulation.snapshot(0), 0)), 1e-5);
    };
    test::holds("mass ratio 1e6, w h 1.5", [&](const Solver& s, Judge& judge) { settle(s, judge, 50); });
    test::holds("mass ratio 1e6, w h 19", [&](const Solver& s, Judge& judge) { settle(s, judge, 4); });
}

// A frame of 0.5 s among frames of 1/60 s, with as many substeps: w h goes from 0.5 to 15. Finite, and whole
// again after 5 s. Nothing in a simulation holds the step (docs/hard-cases.md): what runs one asks
// substepsNeeded.
TEST_CASE("hard: a frame hitch", "[hard][stiff]") {
    const auto hitch = [](const Solver& solver, Judge& judge, bool asks) {
        Scene scene = test::sceneOf(test::leaf(3600, 10), solver.kind, {at({0, 0, 0}, test::turned())});
        const Molecule& molecule = scene.groups[0].molecule;
        scene.groups[0].velocity = {1, 0, 0};
        scene.groups[0].spin = {1, 2, 3};
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        test::runChecked(simulation, 30);
        simulation.parameters.frameTime = 0.5;
        if (asks) simulation.parameters.substeps = substepsNeeded(simulation.plan(), 0.5, 1, 1, 1, 4);
        test::runChecked(simulation, 1);
        // an ill-timed step may stretch springs, not tear them
        judge.atMost("strain after it", test::strainOf(molecule, test::stateOf(simulation.snapshot(0), 0)),
                     1);
        simulation.parameters.frameTime = 1 / 60.0;
        simulation.parameters.substeps = 4;
        test::runChecked(simulation, 300);
        judge.atMost("at the end", test::strainOf(molecule, test::stateOf(simulation.snapshot(0), 0)), 0.3);
    };
    test::holds("frame hitch, same substeps", [&](const Solver& s, Judge& judge) { hitch(s, judge, false); });
    test::holds("frame hitch, substepsNeeded", [&](const Solver& s, Judge& judge) { hitch(s, judge, true); });
}

// The molecule is its own image at the start, and stays so. Only the order of the springs adds an asymmetry,
// measured in m at a size of about 1: 1e-6 is 80 random roundings of 6e-8 m, and 1e-12 is the same in double,
// with room for how the springs amplify it.
TEST_CASE("hard: a symmetric stretch", "[hard][stiff]") {
    const auto stretch = [](const Solver& solver, Judge& judge, const Symmetric& shape) {
        const auto asymmetry = [&](const reference::State& state) {
            double out = 0;
            for (size_t v = 0; v < shape.image.size(); ++v)
                out = std::max(out,
                               glm::length(state.position[v] - shape.signs * state.position[shape.image[v]]));
            return out;
        };
        Scene scene = test::sceneOf(shape.molecule, solver.kind);
        const glm::dvec3 stretched{1.02, 1, 1};
        setSteps(scene, 1 / 60.0, 8);
        Simulation simulation = test::hardSimulation(scene);
        test::startFrom(simulation, [&](GroupState& start) {
            for (size_t v = 0; v < shape.image.size(); ++v)
                test::moveTo(start, v, stretched * test::placeOf(start, v));
        });
        const reference::Problem problem = test::problemOf(scene, 0);
        reference::State exact = reference::restState(problem);
        for (glm::dvec3& x : exact.position)
            x *= stretched;
        for (int i = 0; i < 10; ++i) {
            test::runChecked(simulation, 1);
            judge.atMost("float", asymmetry(test::stateOf(simulation.snapshot(0), 0)), 1e-6);
        }
        reference::frame(problem, exact, solver.kind, 10 / 60.0, 80);
        judge.atMost("double", asymmetry(exact), 1e-12);
    };
    test::holds("symmetric stretch of a square",
                [&](const Solver& s, Judge& judge) { stretch(s, judge, squareOf(2000, 5)); });
    test::holds("symmetric stretch of a triangle",
                [&](const Solver& s, Judge& judge) { stretch(s, judge, triangleOf(2000, 5)); });
}

}  // namespace shoal
