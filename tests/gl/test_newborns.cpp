// Newborns until the end of their first frame, against closed forms, and how long they live.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gl/births.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr double frameTime = 1 / 50.0;

// Born all through the one frame that is run.
Scene streaming(const glm::dvec3& velocity) {
    Emitter emitter = steady(5000);
    emitter.direction = velocity == glm::dvec3(0) ? glm::dvec3(0, 1, 0) : glm::normalize(velocity);
    emitter.speed = glm::dvec2(glm::length(velocity));
    Scene scene = emitting(emitter, 200);
    scene.gravity = {};
    setSteps(scene, frameTime, 1);
    return scene;
}

std::vector<Living> afterAFrame(const Scene& scene) {
    Simulation simulation = simulationOf(scene);
    simulation.frame();
    std::vector<Living> out = livingOf(simulation);
    REQUIRE(out.size() >= 99);
    return out;
}

}  // namespace

// A newborn meets the wind to second order: the moment at which the wind is read matters by w age / 2, a
// quarter, and (w age)^2 / 24, one in a hundred, is left.
TEST_CASE("a newborn meets the wind of its time", "[births]") {
    if (!canSpawn()) return;
    const double wave = 8 * std::numbers::pi, rate = 2, peak = 3;
    Scene scene = streaming({});
    scene.groups[0].drag = {rate, rate};
    scene.fields.push_back({.name = "wind", .shape = OscillatingField{{peak, 0, 0}, 4, 0.3}, .box = {}});
    const auto particular = [&](double t) {
        return peak * rate * (rate * std::sin(wave * t + 0.3) - wave * std::cos(wave * t + 0.3)) /
               (rate * rate + wave * wave);
    };
    for (const Living& one : afterAFrame(scene)) {
        const double expected =
            particular(frameTime) - particular(frameTime - one.age) * std::exp(-rate * one.age);
        INFO("age " << one.age);
        CHECK(std::abs(one.velocity.x - expected) < 0.02 * peak * rate * one.age + 1e-6);
    }
}

// u = k y: on its way up at w, little dragged, v = g k w age^2 / 2.
TEST_CASE("a newborn meets the wind of its place", "[births]") {
    if (!canSpawn()) return;
    Scene scene = streaming({0, 5, 0});
    scene.groups[0].drag = {0.05, 0.05};
    ShearField shear;
    shear.gradient[1][0] = 100;
    scene.fields.push_back({.name = "shear", .shape = shear, .box = {}});
    for (const Living& one : afterAFrame(scene)) {
        INFO("age " << one.age);
        CHECK(one.velocity.x == Approx(0.05 * 100 * 5 * one.age * one.age / 2).epsilon(0.01).margin(1e-6));
    }
}

// A flat leaf falls along its normals.
TEST_CASE("a newborn leaf falls at the drag across its surface", "[births]") {
    if (!canSpawn()) return;
    const double rate = 30, g = 9.81;
    Scene scene = streaming({});
    scene.gravity = {0, -g, 0};
    Molecule& leaf = scene.groups[0].molecule = test::leaf(100, 1);
    for (Vertex& vertex : leaf.vertices)
        vertex.position.y = 0;
    scene.groups[0].drag = {rate, 1};
    scene.groups[0].life->turn = Placement::Turn::none;
    Simulation simulation = simulationOf(scene);
    simulation.frame();
    const GroupState state = simulation.save().groups[0];
    int living = 0;
    for (size_t m = 0; m < state.lives.size(); ++m) {
        if (state.lives[m].y <= 0) continue;
        ++living;
        const double age = double(state.lives[m].x);
        const double fallen = g / rate * (age + std::expm1(-rate * age) / rate);
        for (size_t v = 0; v < 4; ++v)
            CHECK(double(state.anchors[m].y + state.positions[4 * m + v].y) == Approx(-fallen).margin(2e-6));
    }
    CHECK(living >= 99);
}

TEST_CASE("newborns' muscles begin at phases that are spread", "[births]") {
    if (!canSpawn()) return;
    Scene scene = streaming({});
    scene.groups[0].molecule = test::pair(1, 1, 100, 1);
    scene.groups[0].molecule.springs[0].actuation = Actuation{0.1, 1, 0};
    scene.groups[0].phaseSpread = 2;
    Simulation simulation = simulationOf(scene);
    simulation.frame();
    const GroupState state = simulation.save().groups[0];
    double low = 1e9, high = -1e9;
    for (size_t m = 0; m < state.lives.size(); ++m) {
        if (state.lives[m].y <= 0) continue;
        low = std::min(low, double(state.looks[m].y));
        high = std::max(high, double(state.looks[m].y));
    }
    CHECK((low >= 0 && low < 0.2));
    CHECK((high < 2 && high > 1.8));
}

// From 5 cm it comes to rest on the floor after 0.1 s and touches it in every frame.
TEST_CASE("what lies on a collider lives as long after its first touch, and never longer than it would",
          "[births]") {
    if (!canSpawn()) return;
    for (const bool dies : {false, true}) {
        Emitter emitter = burst(10);
        emitter.position = {0, 0.05, 0};
        Scene scene = emitting(emitter, 10, glm::dvec2(dies ? 0.3 : 9));
        scene.gravity = {0, -10, 0};
        scene.colliders.push_back({.name = "floor", .shape = PlaneCollider{}});
        scene.colliders[0].restitution = 0;
        scene.groups[0].life->afterContact = dies ? 5 : 0.2;
        Simulation simulation = simulationOf(scene);
        run(simulation, 15);
        CHECK(simulation.lifeCounts(0).live == 10);
        run(simulation, 6);
        CHECK(simulation.lifeCounts(0).live == 0);
    }
}
