// Contact of molecules where a collider or a triangle takes part, against closed forms.
#include <cmath>

#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using glm::dvec3;
using test::at;

namespace {

Simulation simulationOn(Path path, const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.path = path});
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
    const Path path = test::pathHere();
    if (path == Path::pingPong) return;
    for (const double d : {1e-3, 1e-5}) {
        for (const double slide : {2.0, 0.0}) {
            Scene scene = sceneOfGroups({marble("low", {0, radius + d, 0}, {slide, 0, 0}),
                                         marble("high", {0, d + 3 * radius + 0.5 * step, 0}, {slide, -1, 0})},
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
    const Path path = test::pathHere();
    if (path == Path::pingPong) return;
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

TEST_CASE("spheres on triangles hold a sheet on what fits between its vertices", "[molecule contact]") {
    const Path path = test::pathHere();
    if (path == Path::pingPong) return;
    const bool triangles = GENERATE(false, true);
    Scene scene = test::sceneOf(test::sheet(3, 3, false), SolverKind::leapfrog, {at({-0.5, 0.6, -0.5})});
    Group& sheet = scene.groups[0];
    for (Spring& spring : sheet.molecule.springs)
        spring.actuation.reset();
    sheet.contact.emplace().radius = 0.025;
    sheet.contact->triangles = triangles;
    sheet.restitution = 0;
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {test::collider(test::plane({0, 1, 0}), 0, 0.5, 0)};
    for (const double x : {-0.5, 0.5})
        for (const double z : {-0.5, 0.5})
            scene.colliders.push_back(
                test::collider(SphereCollider{{0.5 * x, 0.3, 0.5 * z}, 0.2}, 0, 0.5, 0));
    test::setStableSubsteps(scene);
    Simulation simulation = simulationOn(path, scene);
    test::run(simulation, 120);
    double lowest = 1e9;
    for (const dvec3& place : simulation.snapshot(0).positions)
        lowest = std::min(lowest, place.y);
    CAPTURE(name(path), triangles, lowest);
    CHECK((lowest > 0.3) == triangles);
}

// Still on each kind of text that colliders have: a plane alone, several at once, the table, a distance
// field; in every form and on every path.
TEST_CASE("spheres of contact rest on colliders by their radius, times their molecule's scale",
          "[molecule contact]") {
    const char* const kind = GENERATE("plane", "sphere", "table", "distance field", "moving");
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog,
                                {at({-1, 0.4, 0}), at({0, 0.4, 0}), at({1, 0.4, 0})});
    scene.groups[0].place.items[2].scale = 2;
    scene.groups[0].contact.emplace().radius = radius;
    scene.groups[0].drag = {4, 4};
    scene.gravity = {0, -9.81, 0};
    test::setSteps(scene, 1 / 60.0, 4);
    constexpr double thickness = 0.002;
    const auto add = [&](ColliderShape shape) {
        scene.colliders.push_back(test::collider(std::move(shape), 0, 1, thickness));
    };
    const std::string name = kind;
    if (name == "plane" || name == "sphere" || name == "table") add(test::plane({0, 1, 0}));
    if (name == "sphere") add(SphereCollider{{0, -5, 0}, 5.02});
    for (int i = 0; i < (name == "table" ? 300 : 0); ++i)
        add(SphereCollider{{0.03 * i - 4.5, -5, 0}, 5.02});
    if (name == "distance field") {
        DistanceFieldCollider field;
        field.field.grid = {{5, 5, 5}, {-2, -2, -2}, 1};
        for (int z = 0; z < 5; ++z)
            for (int y = 0; y < 5; ++y)
                for (int x = 0; x < 5; ++x)
                    field.field.distances.push_back(float(y - 2));
        field.field.outside = -2;
        add(std::move(field));
    }
    if (name == "moving") {
        add(BoxCollider{{0, -1, 0}, {10, 2, 10}});
        scene.colliders[0].path = ColliderPath{{{0, {}}, {10, {}}}};
    }
    Simulation simulation = simulationOn(testPath(), scene);
    test::run(simulation, 120);
    const Snapshot end = simulation.snapshot(0);
    CAPTURE(name);
    for (size_t m = 0; m < 3; ++m) {
        const double ground = (name == "sphere" && m == 1) || name == "table" ? 0.02 : 0;
        const double own = m == 2 ? 2 * radius : radius;
        CHECK(end.positions[m].y == Approx(ground + own).margin(2e-4));
        CHECK(glm::length(end.velocities[m]) < 1e-3);
    }
}

TEST_CASE("a particle that grows touches the floor, and others, as large as it is", "[molecule contact]") {
    const Path path = test::pathHere();
    if (path == Path::pingPong) return;
    const Scene scene = parseScene(
        R"({"format": "shoal-scene-1", "gravity": [0, -9.81, 0],
            "colliders": [{"type": "plane", "restitution": 0}, {"type": "plane", "point": [0, -9, 0]}],
            "groups": [{"particle": {"mass": 1, "shape": "quads", "size": 0.2, "blend": "none", "growth": [0.5, 1.5]},
                "place": {"on": "list", "items": [{"position": [0, 0.07, 0]}, {"position": [0, 0.2, 0]}]},
                "life": {"span": 2, "capacity": 2}, "contact": {"radius": 0.1}, "restitution": 0, "drag": 2}]})",
        "grows.json");
    Simulation simulation = simulationOn(path, scene);
    for (const double age : {1.0, 1.5}) {
        test::run(simulation, age == 1 ? 60 : 30);
        const double own = 0.1 * (0.5 + age / 2);
        const Snapshot now = simulation.snapshot(0);
        CAPTURE(name(path), age);
        CHECK(now.positions[0].y == Approx(own).margin(0.02 * own));
        CHECK(now.positions[1].y == Approx(3 * own).margin(0.06 * own));
    }
}

TEST_CASE("UberFlow's response parts what overlaps at rest", "[molecule contact]") {
    const Path path = test::pathHere();
    if (path == Path::pingPong) return;
    Scene scene = sceneOfGroups({marble("a", {0, 0, 0}, {}), marble("b", {0.15, 0, 0}, {})}, 0);
    scene.contact.response = ContactResponse::nearest;
    Simulation simulation = simulationOn(path, scene);
    simulation.frame();
    CAPTURE(name(path));
    CHECK(simulation.snapshot(0).positions[0].x == Approx(-0.025).margin(1e-6));
    CHECK(simulation.snapshot(1).positions[0].x == Approx(0.175).margin(1e-6));
}

}  // namespace shoal
