// The passes against closed forms, beside the hard cases (tests/hard). Tolerances state what float leaves:
// positions are kept within 1 m of an anchor, so that one rounding is 6e-8 m at most.
#include <cmath>
#include <utility>

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

TEST_CASE("the passes follow the exact discrete recurrence to rounding", "[numerics]") {
    Molecule molecule = test::leaf(400, 2);
    molecule.springs[5].actuation = Actuation{0.2, 3, 0.7};
    for (SolverKind kind : test::solversHere()) {
        for (const Drag drag : {Drag{0, 0}, Drag{1.5, 1.5}, Drag{8, 0.5}, Drag{9000, 6000}}) {
            if (drag.normal / 240 > solver(kind).mostDragged) continue;
            for (bool pinned : {false, true}) {
                molecule.vertices[0].pinned = pinned;
                Scene scene = test::sceneOf(molecule, kind, {at({1, 2, 3}, test::turned(), 0.75)});
                scene.gravity = {0.5, -9.81, 0};
                Group& group = scene.groups[0];
                group.drag = drag;
                group.stiffness = 1.5, group.damping = 0.5, group.phaseSpread = 2;
                group.velocity = {1, 0, 0};
                group.spin = {0.5, 2, -1};
                scene.fields.push_back(test::field(test::shear()));
                scene.fields.back().weight = 0.5;
                setSteps(scene, 1 / 60.0, 4);
                Simulation simulation = test::simulationOf(scene);
                reference::State state = test::stateOf(simulation.snapshot(0), 0);
                const reference::Problem problem = test::problemOf(scene, 0);
                // what has history goes on with it; what has none starts every frame anew
                const int frames = solver(kind).history ? 1 : 30;
                for (int i = 0; i < frames; ++i)
                    reference::frame(problem, state, kind, 0.5 / frames, 120 / frames);
                run(simulation, 30);
                const reference::State passes = test::stateOf(simulation.snapshot(0), 0);
                INFO(name(kind) << " drag " << drag.normal << ", " << drag.tangent << " pinned " << pinned);
                CHECK(reference::relativeError(passes, state, 1) < 5e-6);
                reference::State velocities = passes, expected = state;
                velocities.position = passes.velocity, expected.position = state.velocity;
                CHECK(reference::relativeError(velocities, expected, 1) < 1e-4);
            }
        }
    }
}

TEST_CASE("terminal velocity is u + g / gamma whatever gamma h", "[numerics]") {
    const glm::dvec3 wind{2, 0.5, -1}, gravity{0, -9.81, 0};
    const double h = 1 / 240.0;
    for (SolverKind kind : bothSolvers) {
        Scene scene = test::sceneOf(test::point(1), kind);
        scene.gravity = gravity;
        scene.fields.push_back(test::field(UniformField{wind}));
        scene.groups[0].drag = {240, 240};  // gamma h = 1, times the factor below
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::simulationOf(scene);
        for (double product = 1e-3; product < 2e5; product *= 10) {
            simulation.restart();
            simulation.parameters.drag = product;
            simulation.parameters.substeps = 1000;
            simulation.parameters.frameTime = 1000 * h;
            const glm::dvec3 terminal = wind + gravity / (240 * product);
            // from rest, until e^-18 of the difference is left
            run(simulation, std::max(1, int(std::ceil(18 / (1000 * product)))));
            const glm::dvec3 off = simulation.snapshot(0).velocities[0] - terminal;
            // a velocity stops when its change in a step is less than half a rounding step: 6e-8 v / (gamma
            // h)
            const double tolerance = (1e-5 + 6e-8 / product) * glm::length(terminal);
            INFO(name(kind) << " gamma h " << product << " off " << glm::length(off) / glm::length(terminal));
            CHECK(glm::length(off) < tolerance);
        }
    }
}

TEST_CASE("a molecule 100 km out moves as one at the origin", "[numerics]") {
    const glm::dvec3 far{1e5, -1e5, 1e5 + 0.0625};
    for (SolverKind kind : bothSolvers) {
        reference::State states[2];
        double errors[2];
        for (int i = 0; i < 2; ++i) {
            const glm::dvec3 origin = i == 0 ? glm::dvec3(0) : far;
            Scene scene = test::sceneOf(test::leaf(100, 0.5), kind, {at(origin, test::turned())});
            scene.gravity = {0, -9.81, 0};
            scene.groups[0].drag = {1, 1};
            scene.groups[0].spin = {1, 2, 0.5};
            ShearField shear = test::shear();
            shear.origin = origin;
            scene.fields.push_back(test::field(shear));
            setSteps(scene, 1 / 60.0, 8);
            Simulation simulation = test::simulationOf(scene);
            const auto solution = reference::solve(test::problemOf(scene, 0),
                                                   test::stateOf(simulation.snapshot(0), 0), 1, 1e-7);
            REQUIRE(solution.converged);
            run(simulation, 60);
            states[i] = test::stateOf(simulation.snapshot(0), 0);
            errors[i] = reference::relativeError(states[i], solution.state, 1);
            for (glm::dvec3& x : states[i].position)
                x -= origin;
        }
        INFO(name(kind) << " errors " << errors[0] << " " << errors[1]);
        CHECK(errors[1] == Approx(errors[0]).epsilon(0.01).margin(1e-6));
        CHECK(reference::relativeError(states[0], states[1], 1) < 1e-6);
    }
}

// The tension in a link is the weight of what hangs from it; two sweeps a substep leave strains of 0.1 to
// 0.5.
TEST_CASE("auto strains a hanging chain of stiff springs by its weight and no more", "[numerics]") {
    if (testPath() == Path::pingPong) return;  // which refuses implicit solvers
    Scene scene = test::sceneOf(test::hangingChain(20, 1e5, 20), SolverKind::leapfrog);
    scene.solver.kind.reset();
    scene.gravity = {0, -100, 0};
    Simulation simulation = test::simulationOf(scene);
    run(simulation, 240);
    CHECK(test::worstStrain(scene.groups[0].molecule, test::stateOf(simulation.snapshot(0), 0)) ==
          Approx(19 * 0.01 * 100 / (1e5 * 0.1)).margin(1e-5));
}

// Two sweeps a substep leave 0.06, 0.19, 0.23 and 0.07.
TEST_CASE("auto strains overdamped springs in spin as the reference does", "[numerics]") {
    if (testPath() == Path::pingPong) return;
    for (const auto& [damping, substeps] : {std::pair(10.0, 4), {100.0, 4}, {1e3, 4}, {1e4, 16}}) {
        Scene scene = test::sceneOf(test::regularTetrahedron(100, damping), SolverKind::leapfrog);
        scene.solver.kind.reset();
        scene.gravity = {0, 0, 0};
        scene.groups[0].spin = {5, 3, 20};
        scene.solver.substeps = substeps;
        Simulation simulation = test::simulationOf(scene);
        const reference::State exact =
            reference::integrate(test::problemOf(scene, 0), test::stateOf(simulation.snapshot(0), 0), 0.5,
                                 20000 + int64_t(200 * damping));
        run(simulation, 30);
        const Molecule& molecule = scene.groups[0].molecule;
        INFO(damping);
        CHECK(test::worstStrain(molecule, test::stateOf(simulation.snapshot(0), 0)) ==
              Approx(test::worstStrain(molecule, exact)).margin(6e-3));
    }
}

}  // namespace shoal
