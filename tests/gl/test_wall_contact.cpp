// Contact of molecules where a collider or a triangle takes part, against closed forms.
#include <cmath>

#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using glm::dvec3;
using test::at;

namespace {

Simulation simulationOn(Path path, const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.path = path});
}

// Compute shaders, where there are some, and fragments.
std::vector<Path> fusedPaths() {
    if (testContext().info().computeShaders) return {Path::fused, Path::fragments};
    return {Path::fragments};
}

constexpr double radius = 0.1, step = 0.01;

Group marble(const std::string& name, const dvec3& position, const dvec3& velocity) {
    Group out = test::sceneOf(test::point(1), SolverKind::leapfrog, {at(position)}).groups[0];
    out.name = name;
    out.velocity = velocity;
    out.contact.emplace().radius = radius;
    return out;
}

Scene sceneOfGroups(std::vector<Group> groups, double restitution) {
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog);
    scene.gravity = {};
    scene.groups = std::move(groups);
    for (Group& group : scene.groups) {
        group.restitution = restitution;
        group.friction = 0;
    }
    scene.contact.iterations = 60;
    test::setSteps(scene, step, 1);
    return scene;
}

}  // namespace

// One marble comes down at 1 m/s on another that slides d above the floor. Both go on down at d a step, which
// just reaches the floor. The floor has taken the rest of the momentum, 1 m/s - 2 d / step, and rubs with mu
// of it.
TEST_CASE("a marble is pressed down to the floor and no further, and the floor rubs", "[molecule contact]") {
    const Path path = GENERATE(Catch::Generators::from_range(fusedPaths()));
    for (const double d : {1e-3, 1e-5}) {
        for (const double slide : {2.0, 0.0}) {
            Scene scene = sceneOfGroups({marble("low", {0, d, 0}, {slide, 0, 0}),
                                         marble("high", {0, d + 2 * radius + 0.5 * step, 0}, {slide, -1, 0})},
                                        0);
            scene.colliders = {test::collider(test::plane({0, 1, 0}), 0, 0.3, 0),
                               test::collider(PlaneCollider{{0, -50, 0}, {0, 1, 0}}, 0, 0.8, 0)};
            Simulation simulation = simulationOn(path, scene);
            simulation.frame();
            const dvec3 low = simulation.snapshot(0).velocities[0],
                        high = simulation.snapshot(1).velocities[0];
            CAPTURE(name(path), d, slide, low.x, low.y, high.x, high.y);
            CHECK(low.y == Approx(-d / step).margin(2e-3));
            CHECK(high.y == Approx(-d / step).margin(2e-3));
            CHECK(low.x == Approx(slide > 0 ? slide - 0.3 * (1 - 2 * d / step) : 0).margin(2e-3));
        }
    }
}

// Its corners, a kilogram each, are struck in their middle: 3 kg.
TEST_CASE("a marble bounces off a triangle as off its three corners", "[molecule contact]") {
    const Path path = GENERATE(Catch::Generators::from_range(fusedPaths()));
    Group triangle = marble("triangle", {0, 0, 0}, {});
    Molecule molecule;
    molecule.name = "triangle";
    for (int i = 0; i < 3; ++i)
        molecule.vertices.push_back({.position = {std::cos(2.1 * i), 0, -std::sin(2.1 * i)}, .mass = 1});
    molecule.triangles = {{0, 1, 2}};
    dvec3 middle(0);
    for (const Vertex& vertex : molecule.vertices)
        middle += vertex.position / 3.0;
    triangle.molecule = molecule;
    triangle.contact->triangles = true;
    const Scene scene =
        sceneOfGroups({triangle, marble("marble", middle + dvec3(0, 2 * radius + 0.053, 0), {0, -1, 0})}, 1);
    Simulation simulation = simulationOn(path, scene);
    test::run(simulation, 20);
    CAPTURE(name(path));
    CHECK(simulation.snapshot(1).velocities[0].y == Approx(0.5).margin(1e-3));
    for (const dvec3& v : simulation.snapshot(0).velocities)
        CHECK(v.y == Approx(-0.5).margin(1e-3));
}

TEST_CASE("UberFlow's response parts what overlaps at rest", "[molecule contact]") {
    const Path path = GENERATE(Catch::Generators::from_range(fusedPaths()));
    Scene scene = sceneOfGroups({marble("a", {0, 0, 0}, {}), marble("b", {0.15, 0, 0}, {})}, 0);
    scene.contact.response = ContactResponse::nearest;
    Simulation simulation = simulationOn(path, scene);
    simulation.frame();
    CAPTURE(name(path));
    CHECK(simulation.snapshot(0).positions[0].x == Approx(-0.025).margin(1e-6));
    CHECK(simulation.snapshot(1).positions[0].x == Approx(0.175).margin(1e-6));
}

}  // namespace shoal
