// Birth and death: when, how many, where they find a place, and that nothing of it depends on chance.
#include <algorithm>
#include <cmath>

#include "gl/births.h"
#include "gl/feature_scenes.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "simulate/fused.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using Kind = gpu::Traffic::Kind;

namespace {

constexpr Allocator allocators[] = {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap};

// Under constant gravity g and drag towards a uniform wind u, `age` after a start from rest at the origin.
glm::dvec3 closedForm(const glm::dvec3& v0, const glm::dvec3& g, const glm::dvec3& u, double gamma,
                      double age) {
    const glm::dvec3 terminal = u + g / gamma;
    return terminal * age + (v0 - terminal) * (-std::expm1(-gamma * age) / gamma);
}

}  // namespace

TEST_CASE("a path from a birth within the frame matches the closed form", "[births]") {
    if (!canSpawn()) return;
    const glm::dvec3 g(0, -9.81, 0), u(2, 0.5, -1);
    for (const double gamma : {1e-4, 1.5, 40.0}) {
        Emitter emitter = steady(777);
        emitter.position = {3.3, 2.2, 1.1};
        emitter.direction = {0.6, 0.8, 0};
        emitter.speed = {5, 5};
        Scene scene = emitting(emitter, 2000);
        scene.gravity = g;
        scene.groups[0].drag = {gamma, gamma};
        scene.fields.push_back({.name = "wind", .shape = UniformField{u}, .box = {}});
        setSteps(scene, 1.0 / 60, 4);
        Simulation simulation = simulationOf(scene);
        run(simulation, 45);
        const std::vector<Living> living = livingOf(simulation);
        // birth number k at (k + 1) / rate
        REQUIRE(std::abs(int(living.size()) - int(0.75 * 777)) <= 1);
        double worst = 0, worstAge = 0;
        for (size_t k = 0; k < living.size(); ++k) {
            const double age = 0.75 - double(k + 1) / 777;
            worstAge = std::max(worstAge, std::abs(living[k].age - age));
            const glm::dvec3 expected =
                emitter.position + closedForm(5.0 * emitter.direction, g, u, gamma, age);
            worst = std::max(worst, glm::length(living[k].position - expected));
        }
        INFO("gamma " << gamma << ", ages within " << worstAge);
        CHECK(worstAge < 2e-6);
        // leapfrog after the frame of birth: of second order in gamma h
        const double h = 1.0 / 240;
        CHECK(worst < 2e-5 + 0.2 * gamma * gamma * h * h);
    }
}

TEST_CASE("within the frame of its birth a point flies exactly", "[births]") {
    if (!canSpawn()) return;
    for (const double gamma : {0.0, 1e-5, 0.3, 5.0, 600.0}) {
        Emitter emitter = steady(40000);
        emitter.direction = {0, 1, 0};
        emitter.speed = {7, 7};
        Scene scene = emitting(emitter, 1000);
        scene.gravity = {0, -9.81, 0};
        scene.groups[0].drag = {gamma, gamma};
        setSteps(scene, 1.0 / 60, 1);
        Simulation simulation = simulationOf(scene);
        simulation.frame();
        const std::vector<Living> living = livingOf(simulation);
        REQUIRE(living.size() == 666);
        for (const Living& one : living) {
            const double t = one.age;
            const glm::dvec3 expected = gamma > 0 ? closedForm({0, 7, 0}, scene.gravity, {}, gamma, t)
                                                  : glm::dvec3(0, 7 * t - 4.905 * t * t, 0);
            INFO("gamma " << gamma << " age " << t);
            CHECK(glm::length(one.position - expected) < 1e-7);
        }
    }
}

TEST_CASE("a moving emitter leaves no clumps", "[births]") {
    if (!canSpawn()) return;
    Emitter emitter = steady(1000);
    ColliderPath path;
    path.keyframes = {{0, {{0, 0, 0}, {1, 0, 0, 0}}}, {1, {{30, 0, 0}, {1, 0, 0, 0}}}};
    emitter.path = path;
    Simulation simulation = simulationOf(emitting(emitter, 1200));
    run(simulation, 30);
    std::vector<double> places;
    for (const Living& one : livingOf(simulation))
        places.push_back(one.position.x);
    std::sort(places.begin(), places.end());
    REQUIRE(places.size() >= 498);
    for (size_t i = 1; i < places.size(); ++i)
        CHECK(std::abs(places[i] - places[i - 1] - 0.03) < 1e-5);  // 30 m/s at 1000/s
}

TEST_CASE("what an emitter on the way inherits is the velocity of its path", "[births]") {
    if (!canSpawn()) return;
    Emitter emitter = burst(10, 0.1);
    ColliderPath path;
    path.keyframes = {{0, {{0, 0, 0}, {1, 0, 0, 0}}}, {1, {{6, 0, 3}, {1, 0, 0, 0}}}};
    emitter.path = path;
    emitter.inherit = 0.5;
    Simulation simulation = simulationOf(emitting(emitter, 16));
    run(simulation, 12);
    const std::vector<Living> living = livingOf(simulation);
    REQUIRE(living.size() == 10);
    for (const Living& one : living) {
        CHECK(glm::length(one.velocity - glm::dvec3(3, 0, 1.5)) < 1e-5);
        CHECK(glm::length(one.position - (glm::dvec3(0.6, 0, 0.3) + one.velocity * one.age)) < 1e-5);
    }
}

TEST_CASE("lives end when they should, and their places come back", "[births]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : allocators) {
        INFO(name(allocator));
        Simulation simulation = simulationOf(flowing(allocator, 6000, {0.4, 0.6}, 4000));
        run(simulation, 240);
        const LifeCounts counts = simulation.lifeCounts(0);
        // births of the last 0.4 s, and the share of the others: 6000 * 0.5 on average
        CHECK(std::abs(counts.live - 3000) < 150);
        CHECK(std::abs(int(counts.born) - 24000) <= 1);
        CHECK(counts.lost == 0);
        CHECK(counts.capacity == 4000);
        const std::vector<Living> living = livingOf(simulation);
        CHECK(int(living.size()) == counts.live);
        for (const Living& one : living) {
            CHECK(one.age < one.span);
            CHECK(one.span >= 0.4f);
            CHECK(one.span <= 0.6f);
        }
    }
}

TEST_CASE("the heap and the GPU keep what lives together", "[births]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : {Allocator::gpu, Allocator::heap}) {
        INFO(name(allocator));
        Simulation simulation = simulationOf(flowing(allocator, 60000, {0.2, 0.4}, 40000));
        run(simulation, 60);
        for (int i = 0; i < 60; ++i) {
            simulation.frame();
            const LifeCounts counts = simulation.lifeCounts(0);
            CHECK(counts.live > 17000);
            CHECK(counts.mark <= 1.05 * counts.live);
        }
    }
}

TEST_CASE("allocation on the GPU moves nothing, on the CPU four bytes a birth", "[births][traffic]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : allocators) {
        INFO(name(allocator));
        Simulation simulation = simulationOf(flowing(allocator, 6000, {0.4, 0.6}, 4000));
        run(simulation, 10);
        const gpu::Traffic before = testContext().traffic();
        run(simulation, 30);
        const gpu::Traffic moved = testContext().traffic() - before;
        const bool onCpu = allocator == Allocator::stack || allocator == Allocator::heap;
        CHECK(std::abs(int(moved.total(Kind::births)) - (onCpu ? 4 * 3000 : 0)) <= (onCpu ? 4 : 0));
        CHECK(moved.total(Kind::state) == 0);
        CHECK(moved.total(Kind::parameters) == 0);
        CHECK(moved.total(Kind::control) <= 30 * gpu::Traffic::controlBytesPerFrame);
    }
}

TEST_CASE("births beyond the capacity are not born, and counted; the ring cuts lives short", "[births]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : allocators) {
        INFO(name(allocator));
        Scene scene = emitting(burst(1000), 700);
        scene.groups[0].life->emitters.push_back(burst(100, 0.05));
        scene.groups[0].life->allocator = allocator;
        Simulation simulation = simulationOf(scene);
        run(simulation, 6);
        const LifeCounts counts = simulation.lifeCounts(0);
        CHECK(counts.live == 700);
        CHECK(counts.mark == 700);
        CHECK(counts.born == (allocator == Allocator::ring ? 800 : 700));
        CHECK(counts.lost == 400);
        const std::vector<Living> living = livingOf(simulation);
        CHECK(living.size() == 700);
        const auto young =
            std::count_if(living.begin(), living.end(), [](const Living& one) { return one.age < 0.07; });
        CHECK(young == (allocator == Allocator::ring ? 100 : 0));
    }
}

TEST_CASE("a saved run goes on to the same bits, whatever the allocator", "[births][checkpoint]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : allocators) {
        INFO(name(allocator));
        Scene scene = flowing(allocator, 3000, {0.1, 0.7}, 1500);
        scene.groups[0].life->emitters[0].random = true;
        Simulation whole = simulationOf(scene), first = simulationOf(scene), second = simulationOf(scene);
        run(whole, 60);
        run(first, 37);
        run(second, 5);  // has to forget these
        second.load(first.save());
        run(second, 23);
        CHECK(second.hash() == whole.hash());
        const LifeCounts a = whole.lifeCounts(0), b = second.lifeCounts(0);
        CHECK(a.born == b.born);
        CHECK(a.live == b.live);
        whole.restart();
        run(whole, 37);
        CHECK(whole.hash() == first.hash());
    }
}

TEST_CASE("one side of the state, contact steps or two sides: births are the same", "[births]") {
    if (!canSpawn()) return;
    Scene scene = flowing(Allocator::gpu, 3000, {0.1, 0.7}, 1500);
    scene.gravity = {0, -9.81, 0};
    Simulation two = simulationOf(scene);
    Simulation one(testContext(), compile(scene), {.drawn = false, .path = testPath(), .inPlace = true});
    run(two, 40);
    run(one, 40);
    CHECK(two.hash() == one.hash());
    // in four contact steps a frame, as many, of the same ages
    scene.groups[0].contact = GroupContact{};
    scene.groups[0].contact->radius = 1e-6;
    Simulation pieces = simulationOf(scene);
    run(pieces, 40);
    const std::vector<Living> a = livingOf(two), b = livingOf(pieces);
    CHECK(std::abs(int(pieces.lifeCounts(0).born) - int(two.lifeCounts(0).born)) <= 1);
    const auto ages = [](const std::vector<Living>& living) {
        double sum = 0;
        for (const Living& each : living)
            sum += each.age;
        return sum;
    };
    // deaths come at a step's end, which is earlier in pieces
    CHECK(std::abs(ages(a) - ages(b)) < 0.05 * ages(a));
}

TEST_CASE("those at the start die of age, and their places are used", "[births]") {
    if (!canSpawn()) return;
    Scene scene = sceneOf(point(1), SolverKind::leapfrog, std::vector<Item>(50));
    Lifecycle& life = scene.groups[0].life.emplace();
    life.capacity = 60;
    life.life = {0.2, 0.3};
    life.emitters.push_back(burst(60, 0.5));
    Simulation simulation = simulationOf(scene);
    CHECK(simulation.lifeCounts(0).live == 50);
    run(simulation, 11);
    CHECK(simulation.lifeCounts(0).live == 50);
    run(simulation, 9);
    CHECK(simulation.lifeCounts(0).live == 0);
    for (int i = 0; i < 3; ++i) {  // on neither side of the state
        simulation.frame();
        CHECK(livingOf(simulation).empty());
    }
    run(simulation, 12);
    CHECK(simulation.lifeCounts(0).live == 60);
    CHECK(simulation.lifeCounts(0).lost == 0);
}

TEST_CASE("what leaves its box dies, and what touches lives only so long", "[births]") {
    if (!canSpawn()) return;
    Emitter emitter = burst(100);
    emitter.position = {0, 1, 0};
    Scene scene = emitting(emitter, 100);
    scene.gravity = {0, -10, 0};
    SECTION("box") {
        scene.groups[0].life->within = Box{{-1, 0, -1}, {1, 2, 1}};
        Simulation simulation = simulationOf(scene);
        run(simulation, 26);  // at 0.447 s it has fallen 1 m
        CHECK(simulation.lifeCounts(0).live == 100);
        run(simulation, 1);
        CHECK(simulation.lifeCounts(0).live == 0);
        CHECK(simulation.lifeCounts(0).mark <= 100);
    }
    SECTION("contact") {
        scene.colliders.push_back({.name = "floor", .shape = PlaneCollider{}});
        scene.groups[0].life->afterContact = 0.1;
        Simulation simulation = simulationOf(scene);
        run(simulation, 26);
        CHECK(simulation.lifeCounts(0).live == 100);
        run(simulation, 6);
        CHECK(simulation.lifeCounts(0).live == 100);
        run(simulation, 2);
        CHECK(simulation.lifeCounts(0).live == 0);
    }
}
