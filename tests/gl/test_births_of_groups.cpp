// Births from deaths, of molecules, beside contact, in parts, and beyond what a context holds.
#include <algorithm>
#include <cmath>
#include <set>

#include "gl/births.h"
#include "gl/feature_scenes.h"
#include "simulate/fused.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("from a death others are born, where and as fast as it was", "[births]") {
    if (!canSpawn()) return;
    Emitter rocket = burst(20);
    rocket.speed = {10, 10};
    rocket.spread = 1;
    Scene scene = emitting(rocket, 20, {0.31, 0.45});
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].name = "rockets";
    Group sparks = scene.groups[0];
    sparks.name = "sparks";
    sparks.life->capacity = 150;
    sparks.life->life = {1, 1};
    sparks.life->emitters = {fromDeaths("rockets", 7, 1)};
    scene.groups.push_back(sparks);
    setSteps(scene, 1.0 / 60, 8);
    Simulation simulation = simulationOf(scene);
    run(simulation, 18);
    CHECK(simulation.lifeCounts(1).live == 0);
    const std::vector<Living> flying = livingOf(simulation, 0);
    REQUIRE(flying.size() == 20);
    run(simulation, 18);
    CHECK(simulation.lifeCounts(0).live == 0);
    const LifeCounts counts = simulation.lifeCounts(1);
    CHECK(counts.live == 140);
    CHECK(counts.lost == 0);
    // a spark with all of its rocket's velocity is where the rocket would be
    const std::vector<Living> burning = livingOf(simulation, 1);
    for (const Living& rocketThen : flying) {
        const double t = 0.3;
        const glm::dvec3 now = rocketThen.position + rocketThen.velocity * t + 0.5 * scene.gravity * t * t;
        const auto near = std::count_if(burning.begin(), burning.end(), [&](const Living& spark) {
            return glm::length(spark.position - now) < 1e-3;
        });
        CHECK(near == 7);
        // and as old as its rocket has been dead
        for (const Living& spark : burning)
            if (glm::length(spark.position - now) < 1e-3)
                CHECK(std::abs(spark.age - (rocketThen.age + 0.3 - rocketThen.span)) < 1e-5);
    }
}

TEST_CASE("molecules are born in their shape, and go on as molecules", "[births]") {
    if (!canSpawn()) return;
    for (const SolverKind solver : {SolverKind::leapfrog, SolverKind::bdf2Xpbd, SolverKind::bdf2Corotated}) {
        for (const bool apart : {true, false}) {
            INFO(shoal::name(solver) << ", life apart " << apart);
            Molecule molecule = test::leaf(400, 1);
            if (!apart) {
                molecule.vertices.push_back({.position = {0, 0.5, 0}});
                molecule.springs.push_back({0, 4, 400, 1, {}, {}});
                molecule.springs.push_back({1, 4, 400, 1, {}, {}});
                molecule.springs.push_back({2, 4, 400, 1, {}, {}});
            }
            Emitter emitter = burst(40, 0.01);
            emitter.position = {100, 5, -3};
            emitter.speed = {2, 3};
            Scene scene = emitting(emitter, 50, {0.5, 0.5});
            scene.solver.kind = solver;
            scene.groups[0].molecule = molecule;
            scene.groups[0].life->scale = {0.5, 1.5};
            scene.groups[0].life->spin = {3, 3, 3};
            Simulation simulation = simulationOf(scene, true);
            const size_t vertices = molecule.vertices.size();
            const auto worst = [&] {
                const GroupState state = simulation.save().groups[0];
                double out = 0;
                for (size_t m = 0; m < state.lives.size(); ++m) {
                    if (state.lives[m].y <= 0) continue;
                    CHECK(state.looks[m].x >= 0.5f);
                    CHECK(state.looks[m].x <= 1.5f);
                    for (const Spring& spring : molecule.springs) {
                        const glm::vec3 d = state.positions[m * vertices + size_t(spring.a)] -
                                            state.positions[m * vertices + size_t(spring.b)];
                        out = std::max(out, std::abs(double(glm::length(d)) / molecule.restLength(spring) -
                                                     double(state.looks[m].x)));
                    }
                }
                return out;
            };
            run(simulation, 1);
            CHECK(simulation.lifeCounts(0).live == 40);
            CHECK(worst() < 2e-3);  // spinning, for a part of a frame, along straight lines
            run(simulation, 20);
            CHECK(worst() < 0.1);
            CHECK(finite(simulation.snapshot(0)));
            run(simulation, 11);
            CHECK(simulation.lifeCounts(0).live == 0);
        }
    }
}

TEST_CASE("a free place pushes nobody", "[births][contact]") {
    if (!canSpawn()) return;
    // half of a pile dies; the dead lie where the living are
    Emitter emitter = burst(1, 10);
    Scene scene = emitting(emitter, 64, {0.05, 3});
    scene.groups[0].count = 40;
    for (int i = 0; i < 40; ++i)
        scene.groups[0].place.items.push_back(at({0.001 * i, 0, 0}));
    scene.groups[0].contact = GroupContact{};
    scene.groups[0].contact->radius = 0.0001;
    Simulation simulation = simulationOf(scene);
    run(simulation, 5);
    const SavedState saved = simulation.save();
    SavedState pushed = saved;
    // a free place right on a living one
    GroupState& state = pushed.groups[0];
    for (size_t free = 41; free < 64; ++free) {
        state.positions[free] = state.positions[3];
        state.anchors[free] = state.anchors[3];
        state.velocities[free] = {1, 2, 3};
    }
    simulation.load(pushed);
    run(simulation, 3);
    const GroupState after = simulation.save().groups[0];
    simulation.load(saved);
    run(simulation, 3);
    const GroupState without = simulation.save().groups[0];
    for (size_t i = 0; i < 40; ++i)
        CHECK(after.positions[i] == without.positions[i]);
    INFO(after.positions[50].x << " " << after.positions[50].y << " " << state.positions[50].x);
    CHECK(glm::length(after.positions[50] - state.positions[50]) == 0);
}

TEST_CASE("numbers of an emitter change while it runs; another kind asks for another plan", "[births]") {
    if (!canSpawn()) return;
    Simulation simulation = simulationOf(flowing(Allocator::gpu, 600, {5, 5}, 4000));
    run(simulation, 60);
    Lifecycle life = simulation.plan().groups[0].life->cycle;
    life.emitters[0].rate = 6000;
    life.emitters[0].position = {0, 50, 0};
    REQUIRE(simulation.changeLife(0, life));
    run(simulation, 30);
    const LifeCounts counts = simulation.lifeCounts(0);
    CHECK(std::abs(int(counts.born) - 3600) <= 1);
    const std::vector<Living> living = livingOf(simulation);
    CHECK(std::count_if(living.begin(), living.end(), [](const Living& one) { return one.position.y > 40; }) >
          2990);
    life.emitters[0].from = Emitter::From::sphere;
    life.emitters[0].radius = 1;
    CHECK_FALSE(simulation.changeLife(0, life));
    CHECK(simulation.lifeCounts(0).born == counts.born);
}

TEST_CASE("a group in parts spawns and loses the same molecules as one that is whole", "[births]") {
    if (!testContext().info().computeShaders || testPath() == Path::pingPong) return;
    for (const auto& [allocator, leaves] :
         {std::pair(Allocator::gpu, false), std::pair(Allocator::gpu, true),
          std::pair(Allocator::ring, false), std::pair(Allocator::stack, false),
          std::pair(Allocator::heap, false)}) {
        INFO(name(allocator) << (leaves ? ", leaves with contact" : ", points"));
        // some 500 are born in a frame: more than a list of 256, in parts of so many places
        Scene scene = flowing(allocator, 30000, {0.02, 0.1}, 2000);
        if (leaves) {
            scene.groups[0].molecule = shippedMolecule("leaf");
            scene.groups[0].life->scale = {0.5, 1};
            scene.groups[0].contact = GroupContact{};
            scene.groups[0].contact->radius = 0.002;
            scene.solver.substeps = 4;
        }
        scene.groups[0].count = 700;
        scene.groups[0].place.kind = Placement::Kind::volume;
        scene.groups[0].place.box = {{-1, 0, -1}, {1, 1, 1}};
        // as many are born anew from deaths in each part, and some without one
        scene.groups[0].name = "source";
        Emitter fed = fromDeaths("source", 2, 0.5);
        fed.speed = {1, 1};
        fed.spread = 1;
        Group sparks = emitting(fed, 3000, {0.02, 0.05}).groups[0];
        sparks.life->emitters.push_back(steady(600));
        scene.groups.push_back(sparks);
        const Plan plan = compile(scene);
        SimulationOptions options{.path = Path::fused};
        Simulation whole(testContext(), plan, options);
        options.largestPart = 300;
        Simulation split(testContext(), plan, options);
        REQUIRE(whole.state().buffers->front().parts().size() == 1);
        REQUIRE(split.state().buffers->front().parts().size() > 6);
        // a life takes 1 to 6 frames
        for (int frame = 0; frame < 8; ++frame) {
            run(whole, 1);
            run(split, 1);
            for (size_t group = 0; group < 2; ++group) {
                const LifeCounts a = whole.lifeCounts(group), b = split.lifeCounts(group);
                REQUIRE((a.live == b.live && a.mark == b.mark && a.born == b.born && a.lost == b.lost));
            }
            REQUIRE(whole.save().groups == split.save().groups);
        }
        CHECK(whole.lifeCounts(0).born > 3000);
        CHECK(whole.lifeCounts(1).born > 3000);
    }
}

TEST_CASE("more are born in one step than a device takes in one direction of a dispatch", "[births]") {
    if (!testContext().info().computeShaders || testPath() == Path::pingPong) return;
    constexpr int count = 65535 * 64 + 1000;
    Simulation simulation = simulationOf(emitting(burst(count), count + 10));
    run(simulation, 2);
    const LifeCounts counts = simulation.lifeCounts(0);
    CHECK(counts.live == count);
    CHECK(counts.mark == count);
    CHECK(counts.born == uint64_t(count));
    const GroupState state = simulation.save().groups[0];
    CHECK(std::count_if(state.lives.begin(), state.lives.end(),
                        [](const glm::vec2& life) { return life.x > 0 && life.y > 0; }) == count);
}

TEST_CASE("more die in one step than a device takes in one direction of a dispatch", "[births]") {
    if (!testContext().info().computeShaders || testPath() == Path::pingPong) return;
    constexpr int inOne = 65535 * 64, count = inOne + 1000;
    Emitter box = burst(count);
    box.from = Emitter::From::box;
    box.box = {{-50, -50, -50}, {50, 50, 50}};
    Scene scene = emitting(box, count, {0.001, 0.001});
    scene.groups[0].name = "source";
    scene.groups.push_back(emitting(fromDeaths("source", 1, 0), count).groups[0]);
    Simulation simulation = simulationOf(scene);
    run(simulation, 2);
    CHECK(simulation.lifeCounts(1).live == count);
    // each is born where another one died
    const GroupState state = simulation.save().groups[1];
    std::set<float> heights;
    for (size_t i = inOne; i < state.positions.size(); ++i)
        heights.insert(state.anchors[i].y + state.positions[i].y);
    CHECK(heights.size() > 900);
}

TEST_CASE("what dies a step after its place was freed does not live on beyond the reach of steps",
          "[births]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : {Allocator::stack, Allocator::heap}) {
        Scene scene = emitting(burst(10), 100, {1, 1});
        scene.groups[0].life->allocator = allocator;
        Simulation simulation = simulationOf(scene);
        run(simulation, 64);  // frames of 1/60 s
        for (int frame = 0; frame < 4; ++frame) {
            run(simulation, 1);
            CHECK(livingOf(simulation.save().groups[0]).empty());
            CHECK(simulation.lifeCounts(0).live == 0);
        }
    }
}

TEST_CASE("a capacity that fragments cannot hold is refused", "[births]") {
    const Plan plan = compile(emitting(steady(1), 9'000'000));
    PathLimits limits = limitsOf(testContext().info());
    limits.maxTextureSize = 8192;
    CHECK(messageOf([&] { choosePath(plan, Path::fragments, limits); }).find("at most 8388608 do") !=
          std::string::npos);
}

TEST_CASE("the ping-pong path refuses births in one line", "[births]") {
    Scene scene = emitting(steady(1), 10);
    const Plan plan = compile(scene);
    CHECK(messageOf([&] {
              choosePath(plan, Path::pingPong, limitsOf(testContext().info()));
          }).find("birth and death need the fused path") != std::string::npos);
}
