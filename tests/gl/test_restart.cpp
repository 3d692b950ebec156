// A restart recovers from a run that blew up, and undefined texture contents do no harm.
#include <cmath>
#include <limits>

#include "gl/numerics.h"
#include "reference/fields.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("a restart recovers from any state, and no undefined texel is ever used", "[restart]") {
    Scene scene = sceneOf(test::leaf(150, 1), SolverKind::leapfrog, {at({0, 1, 0}), at({1, 2, 3})});
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].drag = {6, 1};
    Simulation simulation(testContext(), compile(scene), {.path = testPath(), .watchdog = false});
    run(simulation, 5);
    const uint64_t before = simulation.hash();
    simulation.parameters.gravity = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    run(simulation, 2);
    REQUIRE_FALSE(finite(simulation.snapshot(0)));
    simulation.parameters.gravity = scene.gravity;
    simulation.restart();
    run(simulation, 5);
    CHECK(simulation.hash() == before);
}

TEST_CASE("a wrapped grid repeats on both sides, and a clamped one ends", "[numerics]") {
    GridField grid;
    grid.resolution = {4, 2, 3};
    grid.low = {-1, 0, 0.5};
    grid.high = {1, 1, 2};
    for (int i = 0; i < 24; ++i)
        grid.values.emplace_back(0.3f * float(i % 5) - 0.5f, 0.1f * float(i), 0.2f * float(i % 7));
    for (const bool wrap : {false, true}) {
        grid.wrap = wrap;
        std::vector<Item> items;
        for (int i = 0; i < 60; ++i)
            items.push_back(at({0.37 * i - 11, 0.11 * (i % 40) - 2, 0.23 * i - 7}));
        Molecule point;
        point.name = "point";
        point.vertices.emplace_back();
        Scene scene = sceneOf(point, SolverKind::euler, items);
        Field field;
        field.shape = grid;
        scene.fields.push_back(field);
        scene.groups[0].drag = {1e6, 1e6};  // carried along at once
        setSteps(scene, 1e-4, 1);
        Simulation simulation = simulationOf(scene);
        const Snapshot start = simulation.snapshot(0);
        simulation.frame();
        const Snapshot end = simulation.snapshot(0);
        for (size_t i = 0; i < items.size(); ++i) {
            INFO("wrap " << wrap << ", point " << i);
            const glm::dvec3 expected = reference::fluidVelocity(scene.fields, start.positions[i], 0);
            CHECK(glm::length(end.velocities[i] - expected) < 2e-5);
        }
    }
}
