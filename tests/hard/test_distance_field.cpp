// Distance fields where they are weakest: thinner than a cell, and of a mesh with holes.
#include <algorithm>
#include <cmath>

#include "hard/outcome.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/solids.h"

namespace shoal {

using test::at;
using test::Judge;
using test::setSteps;

namespace {

constexpr double g = 9.81, thickness = 0.01;

Collider fieldOf(const Mesh& mesh, int resolution) {
    DistanceFieldCollider shape;
    shape.request.resolution = resolution;
    shape.request.thickness = thickness;
    shape.field = bakeDistanceField(mesh, shape.request);
    Collider out;
    out.shape = std::move(shape);
    out.restitution = 0.3;
    out.friction = 0.3;
    out.thickness = thickness;
    return out;
}

// Below where it would rest.
double depthInCells(const DistanceField& field, const glm::dvec3& x) {
    return std::max(0.0, thickness - valueAt(field, x).distance) / field.grid.cell;
}

}  // namespace

// A plate of 4 mm in cells of 25 mm, level and tilted. Falling at up to 5 m/s, 21 mm a step: never deeper
// than half a cell, and none comes out below.
TEST_CASE("hard: a thin distance field", "[hard][contact][distanceField]") {
    const auto fall = [](const Solver& solver, Judge& judge, double tilt) {
        const glm::dvec3 up{std::sin(tilt), std::cos(tilt), 0}, along{std::cos(tilt), -std::sin(tilt), 0};
        Mesh plate;
        test::addBox(plate, {-0.5, -0.002, -0.5}, {0.5, 0.002, 0.5});
        for (glm::dvec3& p : plate.positions)
            p = p.x * along + p.y * up + glm::dvec3(0, 0, p.z);
        completeMesh(plate);
        std::vector<test::Item> items;
        for (int i = 0; i < 25; ++i)
            items.push_back(
                at(0.05 * (i % 5 - 2) * along + glm::dvec3(0, 0.3 + 0.25 * (i / 5), 0.07 * (i % 5))));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = {0, -g, 0};
        scene.colliders = {fieldOf(plate, 40)};
        const DistanceField field = std::get<DistanceFieldCollider>(*scene.colliders[0].shape).field;
        setSteps(scene, 1 / 240.0, 1);
        Simulation simulation = test::hardSimulation(scene);
        for (int i = 0; i < 40; ++i) {
            test::runChecked(simulation, 6);
            for (const glm::dvec3& x : simulation.snapshot(0).positions) {
                judge.atMost("deepest of a cell", depthInCells(field, x), 0.5);
                if (std::abs(glm::dot(x, along)) < 0.5)  // else it may have slid off
                    judge.atMost("below m", std::max(0.0, -glm::dot(x, up)), 0);
            }
        }
    };
    test::holds("thin field, level", [&](const Solver& s, Judge& judge) { fall(s, judge, 0); });
    test::holds("thin field, tilted", [&](const Solver& s, Judge& judge) { fall(s, judge, 0.3); });
}

// A crate without half of its lid: a shell of two cells. What falls beside the hole stays on the lid, what
// falls in stays on the floor, and nothing passes a wall.
TEST_CASE("hard: a distance field of a mesh with holes", "[hard][contact][distanceField]") {
    test::holds("field of a mesh with holes", [](const Solver& solver, Judge& judge) {
        Mesh crate;
        test::addBox(crate, {-0.5, 0, -0.5}, {0.5, 0.6, 0.5});
        crate.triangles.erase(crate.triangles.begin() + 6);  // of the lid: that over x < z
        completeMesh(crate);
        std::vector<test::Item> items;
        for (int i = 0; i < 16; ++i)  // over the hole, then over the lid
            items.push_back(at({0.1 * (i % 4) - 0.4, 0.9 + 0.03 * i, 0.25 + 0.02 * (i % 3)}));
        for (int i = 0; i < 8; ++i)
            items.push_back(at({0.3 + 0.01 * i, 0.8 + 0.05 * i, -0.3}));
        Scene scene = test::sceneOf(test::point(1), solver.kind, items);
        scene.gravity = {0, -g, 0};
        scene.colliders = {fieldOf(crate, 32)};
        const DistanceField field = std::get<DistanceFieldCollider>(*scene.colliders[0].shape).field;
        setSteps(scene, 1 / 60.0, 4);
        Simulation simulation = test::hardSimulation(scene);
        for (int i = 0; i < 36; ++i) {
            test::runChecked(simulation, 5);
            for (const glm::dvec3& x : simulation.snapshot(0).positions)
                judge.atMost("deepest of a cell", depthInCells(field, x), 0.5);
        }
        const Snapshot now = simulation.snapshot(0);
        for (size_t m = 0; m < now.positions.size(); ++m) {
            const double rest = (m < 16 ? 0 : 0.6) + field.shell / 2 + thickness;
            judge.near("off its floor m", now.positions[m].y - rest, 0, 1e-4);
        }
    });
}

}  // namespace shoal
