// Compute shaders and fragments give birth to the same molecules at the same moments, whatever the allocator.
#include "gl/agreement.h"
#include "gl/births.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Simulation on(Path path, const Scene& scene) {
    return Simulation(testContext(), compile(scene), {.drawn = false, .path = path});
}

// Rockets that fly out of a box, or live only so long, or only so long after they have touched the ground;
// and sparks, leaves of four vertices, that are born where one dies.
Scene rockets(Allocator allocator, int capacity) {
    Emitter emitter = steady(0.6 * capacity);
    emitter.random = true;
    emitter.from = Emitter::From::disc;
    emitter.radius = 2;
    emitter.speed = {2, 8};
    emitter.spread = 1;
    emitter.bursts.push_back({0.2, capacity / 2, 0});
    Scene scene = emitting(emitter, capacity, {0.3, 0.9});
    scene.gravity = {0, -9.81, 0};
    PlaneCollider plane;
    plane.point = {0, -0.2, 0};
    scene.colliders.emplace_back().shape = plane;
    Group& first = scene.groups[0];
    first.name = "rockets";
    first.life->allocator = allocator;
    first.life->within = Box{{-3, -1, -3}, {3, 3, 3}};
    first.life->afterContact = 0.05;
    Group sparks = first;
    sparks.name = "sparks";
    sparks.molecule = test::leaf(400, 1);
    sparks.life = Lifecycle();
    sparks.life->capacity = capacity;
    sparks.life->allocator = Allocator::gpu;
    sparks.life->life = {0.1, 0.3};
    sparks.life->scale = {0.5, 1};
    sparks.life->emitters = {fromDeaths("rockets", 3, 0.5)};
    scene.groups.push_back(sparks);
    setSteps(scene, 1.0 / 60, 4);
    return scene;
}

// Both see the same lives; what moves is the same to rounding.
void checkSame(const GroupState& a, const GroupState& b) {
    CHECK(a.seeds == b.seeds);
    CHECK(a.totals == b.totals);
    float ages = 0, places = 0;
    int living = 0;
    const size_t vertices = a.positions.size() / a.lives.size();
    for (size_t m = 0; m < a.lives.size(); ++m) {
        REQUIRE((a.lives[m].y > 0) == (b.lives[m].y > 0));
        if (!(a.lives[m].y > 0)) continue;
        ++living;
        ages = std::max(ages, std::abs(a.lives[m].x - b.lives[m].x));
        CHECK(a.anchors[m] == b.anchors[m]);
        for (size_t v = m * vertices; v < (m + 1) * vertices; ++v)
            places = std::max(places, glm::length(a.positions[v] - b.positions[v]));
    }
    CHECK(living > 10);
    CHECK(ages < 1e-6f);
    CHECK(places < 1e-5f);
}

}  // namespace

TEST_CASE("compute shaders and fragments give birth to the same", "[births][agreement]") {
    if (!canFuse()) return;
    for (const Allocator allocator : {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap}) {
        // so many places that sums over them take one, two and three levels
        for (const int capacity : {900, 3000, 40000}) {
            if (capacity > 3000 && allocator != Allocator::gpu) continue;
            INFO(name(allocator) << ", " << capacity << " places");
            const Scene scene = rockets(allocator, capacity);
            Simulation compute = on(Path::fused, scene), fragments = on(Path::fragments, scene);
            run(compute, 50);
            run(fragments, 50);
            const SavedState a = compute.save(), b = fragments.save();
            for (size_t g = 0; g < 2; ++g) {
                INFO(scene.groups[g].name);
                checkSame(a.groups[g], b.groups[g]);
                const LifeCounts one = compute.lifeCounts(g), other = fragments.lifeCounts(g);
                CHECK(one.live == other.live);
                CHECK(one.mark == other.mark);
                CHECK(one.born == other.born);
                CHECK(one.lost == other.lost);
                CHECK(other.born > 0);
            }
        }
    }
}

TEST_CASE("a run with births goes on in the other form", "[births][checkpoint]") {
    if (!canFuse()) return;
    for (const Allocator allocator : {Allocator::gpu, Allocator::ring, Allocator::stack, Allocator::heap}) {
        INFO(name(allocator));
        const Scene scene = rockets(allocator, 1500);
        Simulation whole = on(Path::fused, scene), first = on(Path::fragments, scene);
        run(whole, 45);
        run(first, 15);
        Simulation second = on(Path::fused, scene);
        second.load(first.save());
        run(second, 15);
        first.load(second.save());
        run(first, 15);
        const SavedState a = whole.save(), b = first.save();
        for (size_t g = 0; g < 2; ++g)
            checkSame(a.groups[g], b.groups[g]);
    }
}
