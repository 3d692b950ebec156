#include "simulate/pick.h"

#include "support/catch.h"

using namespace shoal;

namespace {

// A right triangle in the plane z = 0, with a spring along its first edge.
Molecule corner() {
    Molecule out;
    for (const glm::dvec3& place : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
        Vertex vertex;
        vertex.position = place;
        vertex.mass = 2;
        out.vertices.push_back(vertex);
    }
    Spring first, second;
    first.a = 0, first.b = 1, first.stiffness = 10;
    second.a = 0, second.b = 2, second.stiffness = 10;
    out.springs = {first, second};
    out.triangles = {{0, 1, 2}};
    return out;
}

Snapshot at(const Molecule& molecule, const std::vector<glm::dvec3>& places) {
    Snapshot out;
    out.count = int(places.size());
    out.vertexCount = int(molecule.vertices.size());
    for (const glm::dvec3& place : places)
        for (const Vertex& vertex : molecule.vertices)
            out.positions.push_back(place + vertex.position);
    return out;
}

}  // namespace

TEST_CASE("a click picks the nearest triangle that its ray meets, from either side", "[pick]") {
    const Molecule molecule = corner();
    Snapshot state = at(molecule, {{0, 0, -5}, {0, 0, -2}, {0, 0, 3}});
    const Ray ray{{0.2, 0.2, 0}, {0, 0, -1}};
    auto hit = firstHit(ray, state, molecule, 0, 0);
    REQUIRE(hit);
    CHECK(hit->molecule == 1);
    CHECK(hit->distance == Approx(2));
    state.alive = {true, false, true};
    CHECK(firstHit(ray, state, molecule, 0, 0)->molecule == 0);
    CHECK(firstHit({{0.2, 0.2, 0}, {0, 0, 1}}, state, molecule, 0, 0)->molecule == 2);
    // beyond the longest edge, and past the corner
    CHECK(!firstHit({{0.6, 0.6, 0}, {0, 0, -1}}, state, molecule, 0, 0));
    CHECK(!firstHit({{-0.1, 0.2, 0}, {0, 0, -1}}, state, molecule, 0, 0));
}

TEST_CASE("a click near a vertex picks it where there is no triangle", "[pick]") {
    Molecule point;
    point.vertices.emplace_back();
    const Snapshot state = at(point, {{0, 0, -10}, {0.05, 0, -4}});
    const Ray ray{{0, 0, 0}, {0, 0, -1}};
    CHECK(firstHit(ray, state, point, 0.06, 0)->molecule == 1);
    CHECK(firstHit(ray, state, point, 0.01, 0)->molecule == 0);
    CHECK(firstHit(ray, state, point, 0, 0.02)->molecule == 1);  // 0.05 m at 4 m
    CHECK(!firstHit({{0, 0, 0}, {0, 0, 1}}, state, point, 1, 1));
}

TEST_CASE("the numbers of a molecule are those of its state", "[pick]") {
    const Molecule molecule = corner();
    GroupState state;
    state.anchors = {glm::vec3(10, 0, 0)};
    state.positions = {glm::vec3(0), glm::vec3(3, 0, 0), glm::vec3(0, 1.8f, 0)};
    state.velocities = {glm::vec3(3, 0, 0), glm::vec3(0), glm::vec3(0)};
    state.released = {1};
    state.looks = {glm::vec2(2, 0)};
    state.lives = {glm::vec2(1.5, 1)};
    const MoleculeNumbers numbers = numbersOf(state, molecule, 2);
    CHECK(numbers.middle.x == Approx(11));
    CHECK(numbers.middle.y == Approx(0.6));
    CHECK(numbers.velocity.x == Approx(1));
    CHECK(numbers.kinetic == Approx(9));
    // rest lengths of 2 m: 0.5 * 2 * 10 * (1 + 0.04)
    CHECK(numbers.elastic == Approx(10.4));
    CHECK(numbers.strain == Approx(0.5));
    CHECK(numbers.strained == 0);
    CHECK(numbers.released);
    CHECK(!numbers.alive);
    CHECK(numbers.life->x == 1.5);
}
