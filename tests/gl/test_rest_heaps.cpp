// Heaps with `rest` (shaders/contact/rest/rest.pass.glsl): coming to rest and waking give no energy, and
// nobody stays awake.
#include <algorithm>
#include <cmath>

#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "gl/numerics.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using glm::dvec3;

namespace {

Collider floorOf(double friction) {
    Collider out;
    out.shape = PlaneCollider{};
    out.friction = friction;
    return out;
}

Simulation fusedOf(const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.drawn = false, .path = Path::fused});
}

// 200 leaves that fall from a column onto a floor, too few iterations for such a heap.
Scene leaves(uint64_t seed) {
    Scene scene = sceneOf(shippedMolecule("leaf"), SolverKind::leapfrog);
    scene.seed = seed;
    Group& group = scene.groups[0];
    group.count = 200;
    group.place.kind = Placement::Kind::volume;
    group.place.items.clear();
    group.place.box = {{-0.12, 0.05, -0.12}, {0.12, 1, 0.12}};
    group.place.turn = Placement::Turn::any;
    group.place.scale = {2, 2.6};
    group.held = false;
    group.drag = {9, 0.9};
    group.friction = 0.2;
    group.restitution = 0;
    group.contact.emplace().radius = 0.008;
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {floorOf(0.2)};
    scene.contact.iterations = 4;
    setSteps(scene, 1 / 60.0, 4);
    return scene;
}

// The mean square of the vertices' speeds over so many frames, (mm/s)^2.
double liveliness(Simulation& simulation, int frames) {
    double sum = 0;
    size_t number = 0;
    for (int i = 0; i < frames; ++i) {
        run(simulation, 1);
        for (const dvec3& v : simulation.snapshot(0).velocities)
            sum += 1e6 * glm::dot(v, v);
        number += simulation.snapshot(0).velocities.size();
    }
    return sum / double(number);
}

// 400 marbles that fall from a column onto a floor.
Scene marbles(uint64_t seed) {
    Scene scene = sceneOf(point(0.01), SolverKind::leapfrog);
    scene.seed = seed;
    Group& group = scene.groups[0];
    group.count = 400;
    group.place.kind = Placement::Kind::volume;
    group.place.items.clear();
    group.place.box = {{-0.058, 0.02, -0.058}, {0.058, 0.4, 0.058}};
    group.held = false;
    group.friction = 0.5;
    group.restitution = 0;
    group.contact.emplace().radius = 0.01;
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {floorOf(0.5)};
    scene.contact.iterations = 4;
    scene.contact.rest = 0.005;
    setSteps(scene, 1 / 60.0, 4);
    return scene;
}

}  // namespace

// In the fifth second. Without `rest` leaves creep on; what rests and wakes is to be no livelier.
TEST_CASE("a heap of leaves lies still, and with `rest` is no livelier", "[rest]") {
    if (!canFuse()) return;
    Scene scene = leaves(GENERATE(1, 2, 3));
    double squares[2] = {};  // (mm/s)^2: without, with
    for (const bool rests : {false, true}) {
        if (rests) scene.contact.rest = 0.02;
        Simulation simulation = fusedOf(scene);
        run(simulation, 240);
        squares[rests] = liveliness(simulation, 30);
    }
    CAPTURE(scene.seed, std::sqrt(squares[0]), std::sqrt(squares[1]));
    CHECK(squares[0] < 16);
    CHECK(squares[1] <= 1.02 * squares[0]);
}

// Of 400 leaves, where forces that follow late gave 29 mm/s in the fifth second.
TEST_CASE("a deep heap of leaves lies still", "[rest]") {
    if (!canFuse()) return;
    Scene scene = leaves(1);
    scene.groups[0].count = 400;
    Simulation simulation = fusedOf(scene);
    run(simulation, 240);
    const double speed = std::sqrt(liveliness(simulation, 30));
    CAPTURE(speed);
    CHECK(speed < 10);
}

// A clock of 15 frames is to run while a marble does not move, and what it sticks to draws it back for a step
// or three only.
TEST_CASE("a marble that has stopped comes to rest", "[rest]") {
    if (!canFuse()) return;
    for (const uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        Simulation simulation = fusedOf(marbles(seed));
        std::vector<int> still(400, 0);  // frames for which it has been awake and slower than 1e-6 m/s
        int longest = 0;
        for (int i = 0; i < 100; ++i) {
            run(simulation, 1);
            const std::vector<dvec3> velocities = simulation.snapshot(0).velocities;
            for (size_t k = 0; k < still.size(); ++k) {
                const double speed = glm::length(velocities[k]);
                still[k] = speed > 0 && speed < 1e-6 ? still[k] + 1 : 0;
                longest = std::max(longest, still[k]);
            }
        }
        CAPTURE(seed);
        CHECK(longest <= 20);
    }
}
