// Sliders are moved while a run goes on: within their limits nothing goes wrong, and nothing is lost for
// ever.
#include <algorithm>
#include <cmath>

#include "core/description.h"
#include "gl/births.h"
#include "scene/collider_kinds.h"
#include "simulate/carry_over.h"
#include "support/catch.h"
#include "support/moved.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Everything that a slider moves without another plan.
Lifecycle moved(const Lifecycle& from, Sliders& sliders) {
    Lifecycle out = sliders.moved(from, {"capacity", "scale"});
    for (Emitter& emitter : out.emitters) {
        emitter = sliders.moved(emitter);
        for (Burst& burst : emitter.bursts)
            burst = sliders.moved(burst);
    }
    return out;
}

Emitter from(Emitter::From kind) {
    Emitter out = steady(150);
    out.from = kind;
    out.radius = 0.3;
    out.lineTo = {1, 0, 0};
    out.speed = {1, 2};
    out.spread = 0.3;
    return out;
}

Scene fountain(Allocator allocator) {
    Scene scene = emitting(from(Emitter::From::point), 300, {0.2, 0.4});
    scene.gravity = {0, -9.81, 0};
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{{0, -1, 0}, {0, 1, 0}}});
    Lifecycle& life = *scene.groups[0].life;
    life.allocator = allocator;
    // a CPU's allocator does not hear of such deaths: it keeps the place until the span of life is over
    const bool heard = allocator == Allocator::gpu || allocator == Allocator::ring;
    if (heard) life.within = Box{glm::dvec3(-50), glm::dvec3(50)};
    if (heard) life.afterContact = 0.5;
    life.emitters[0].bursts.push_back({0, 20, 0.1});
    for (const Emitter::From kind :
         {Emitter::From::line, Emitter::From::disc, Emitter::From::sphere, Emitter::From::box})
        life.emitters.push_back(from(kind));
    Emitter& carried = life.emitters.back();
    carried.path = ColliderPath{{{0, {}}, {1, {{1, 0, 0}, glm::angleAxis(1.0, glm::dvec3(0, 1, 0))}}}};
    carried.inherit = 0.5;
    if (allocator != Allocator::gpu) return scene;
    Group smoke = scene.groups[0];
    scene.groups[0].name = "sparks";
    smoke.name = "smoke";
    smoke.life->capacity = 500;
    smoke.life->emitters = {Emitter{}};
    smoke.life->emitters[0].from = Emitter::From::death;
    smoke.life->emitters[0].group = "sparks";
    scene.groups.push_back(smoke);
    setSteps(scene, 1.0 / 60, 1);
    return scene;
}

void checkFinite(const Simulation& simulation, size_t group) {
    const Snapshot snapshot = simulation.snapshot(group);
    const auto finite = [](const glm::dvec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    CHECK(std::all_of(snapshot.positions.begin(), snapshot.positions.end(), finite));
    CHECK(std::all_of(snapshot.velocities.begin(), snapshot.velocities.end(), finite));
}

}  // namespace

TEST_CASE("within the sliders' limits nothing runs away and nothing is lost for ever", "[edits]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap}) {
        const Scene scene = fountain(allocator);
        Simulation simulation = simulationOf(scene);
        run(simulation, 12);
        for (uint64_t round = 0; round < 12; ++round) {
            Sliders sliders(100 * uint64_t(allocator) + round);
            INFO("allocator " << name(allocator) << ", round " << round);
            for (size_t g = 0; g < scene.groups.size(); ++g) {
                const Lifecycle& life = *scene.groups[g].life;
                REQUIRE(simulation.changeLife(g, moved(life, sliders)));
            }
            for (int frame = 0; frame < 5; ++frame) {
                simulation.frame();
                REQUIRE_NOTHROW(simulation.check());
            }
            for (size_t g = 0; g < scene.groups.size(); ++g) {
                checkFinite(simulation, g);
                const LifeCounts counts = simulation.lifeCounts(g);
                CHECK(counts.live >= 0);
                CHECK(counts.live <= counts.capacity);
            }
        }
        // back, and all that is about is gone: what lives then was emitted under the first numbers
        for (size_t g = 0; g < scene.groups.size(); ++g)
            REQUIRE(simulation.changeLife(g, *scene.groups[g].life));
        run(simulation, 30);
        for (size_t g = 0; g < scene.groups.size(); ++g) {
            const LifeCounts before = simulation.lifeCounts(g);
            run(simulation, 15);
            const LifeCounts after = simulation.lifeCounts(g);
            INFO("allocator " << name(allocator) << ", group " << g);
            CHECK(after.live > 20);
            if (allocator != Allocator::heap && allocator != Allocator::stack)
                // without such deaths, all places may be taken by those that live long
                if (scene.groups[g].life->within) CHECK(after.born > before.born);
        }
    }
}

TEST_CASE("a rate of 0, a short life and a late beginning can be taken back", "[edits]") {
    if (!canSpawn()) return;
    const Scene scene = fountain(Allocator::gpu);
    Simulation simulation = simulationOf(scene);
    const Lifecycle& life = *scene.groups[0].life;
    const auto mostOf = [&](const char* key) {
        const Emitter& emitter = life.emitters[0];
        return sliderOf(*describe(&emitter).find(key), &emitter).most;
    };
    const Key& span = *describe(&life).find("span");
    const auto none = [&](Lifecycle edited) {
        REQUIRE(simulation.changeLife(0, edited));
        run(simulation, 30);
        const int few = simulation.lifeCounts(0).live;
        REQUIRE(simulation.changeLife(0, life));
        run(simulation, 15);
        CHECK(simulation.lifeCounts(0).live > 100);
        return few;
    };
    Lifecycle edited = life;
    for (Emitter& emitter : edited.emitters) {
        emitter.rate = 0;
        emitter.bursts.resize(emitter.bursts.size(), Burst{});
        for (Burst& burst : emitter.bursts)
            burst.time = mostOf("begin");
    }
    CHECK(none(edited) == 0);
    edited = life;
    edited.life = glm::dvec2(sliderOf(span, &life).least);
    CHECK(none(edited) < 60);
    edited = life;
    for (Emitter& emitter : edited.emitters) {
        emitter.begin = mostOf("begin");
        for (Burst& burst : emitter.bursts)
            burst.time = mostOf("begin");
    }
    CHECK(none(edited) == 0);
    edited = life;
    for (Emitter& emitter : edited.emitters)
        emitter.speed = glm::dvec2(mostOf("speed"));
    edited.within = Box{glm::dvec3(900), glm::dvec3(901)};
    CHECK(none(edited) < 60);  // who was born in the last frame
}

TEST_CASE("a run goes on with more places, with fewer and with another emitter", "[edits]") {
    if (!canSpawn()) return;
    for (const Allocator allocator : {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap}) {
        INFO(name(allocator));
        const Scene scene = fountain(allocator);
        Simulation simulation = simulationOf(scene);
        run(simulation, 20);
        const SavedState saved = simulation.save();
        const std::vector<Living> before = livingOf(simulation);
        REQUIRE(before.size() > 100);

        for (const int capacity : {700, 300, 90}) {
            Scene other = scene;
            other.groups[0].life->capacity = capacity;
            other.groups[0].life->emitters.push_back(from(Emitter::From::point));
            Simulation next = simulationOf(other);
            const GoneOn gone = goOn(saved, simulation.plan(), next.plan());
            REQUIRE(gone.restarted.empty());
            next.load(gone.state);
            CHECK(next.time() == simulation.time());
            const std::vector<Living> after = livingOf(next);
            size_t kept = 0;
            for (const Living& one : before)
                kept += one.place < size_t(capacity) ? 1 : 0;
            REQUIRE(after.size() == kept);
            for (size_t i = 0; i < kept; ++i) {
                CHECK(after[i].place == before[i].place);
                CHECK(after[i].position == before[i].position);
                CHECK(after[i].age == before[i].age);
            }
            run(next, 20);
            next.check();
            const LifeCounts counts = next.lifeCounts(0);
            CHECK(counts.live > std::min(60, capacity / 2));
            CHECK(counts.live <= capacity);
            CHECK(int(livingOf(next).size()) == counts.live);
        }
        Simulation same = simulationOf(scene);
        same.load(goOn(saved, simulation.plan(), same.plan()).state);
        run(same, 20);
        run(simulation, 20);
        CHECK(same.hash() == simulation.hash());
    }
}

TEST_CASE("a group that is no longer born and dies begins anew", "[edits]") {
    if (!canSpawn()) return;
    const Scene scene = fountain(Allocator::gpu);
    const Simulation simulation = simulationOf(scene);
    Scene other = scene;
    other.groups[1].life.reset();
    other.groups[1].count = 1;
    other.groups[1].place.items.emplace_back();
    const Plan plan = compile(other);
    const GoneOn gone = goOn(simulation.save(), simulation.plan(), plan);
    CHECK(gone.restarted == std::vector<std::string>{"smoke"});
    CHECK(gone.state.groups[1] == plan.groups[1].start);
}
