// Far from the origin the scene's own geometry is as good as the molecules': what happens there is what
// happens at the origin.
#include <algorithm>

#include "gl/births.h"
#include "gl/numerics.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using glm::dvec3;
using test::at;

namespace {

const dvec3 away(100000.3, 99999.7, -77777.1);  // m; floats there are 8 mm apart
const dvec3 level(100000.3, 0, -77777.1);       // for height fields, whose heights are floats of the scene

HeightFieldCollider bumps(const dvec3& origin) {
    HeightFieldCollider out;
    out.columns = out.rows = 9;
    out.low = {origin.x + 9, origin.z - 1}, out.high = {origin.x + 11, origin.z + 1};
    for (int i = 0; i < 81; ++i)
        out.heights.push_back(0.1f * float(i % 4) - 0.05f * float(i % 7));
    return out;
}

ColliderPath lift(const dvec3& from, double angle) {
    ColliderPath path;
    path.keyframes = {{0, {from, {1, 0, 0, 0}}},
                      {1, {from + dvec3(0, 0.5, 0), glm::angleAxis(angle, dvec3(0, 0, 1))}}};
    return path;
}

Collider on(ColliderShape shape, std::optional<ColliderPath> path = {}) {
    Collider out = test::collider(std::move(shape), 0.2, 0.4, 0.002);
    out.path = std::move(path);
    return out;
}

PlaneCollider slope(const dvec3& origin) {
    PlaneCollider out = test::plane({0.1, 1, 0.05});
    out.point = origin + dvec3(6, -0.7, 0);
    return out;
}

// Spread along x, 3 m apart; the last one moves by a path of its own place, that before by a path about it.
std::vector<Collider> colliders(const dvec3& origin) {
    const glm::dquat turned = glm::angleAxis(0.4, dvec3(0.6, 0, 0.8));
    return {on(slope(origin)),
            on(SphereCollider{origin, 0.5}),
            on(BoxCollider{origin + dvec3(3, 0, 0), {1.2, 0.8, 1}, turned}),
            on(CapsuleCollider{origin + dvec3(5.5, 0, 0), origin + dvec3(6.5, 0.2, 0), 0.3}),
            on(SphereCollider{dvec3(0.1, 0, 0), 0.5}, lift(origin + dvec3(13, 0, 0), 0.3)),
            on(BoxCollider{origin + dvec3(16, 0, 0), {1, 0.5, 1}}, lift(dvec3(0), 0))};
}

// More than uniforms hold.
std::vector<Collider> manySpheres(const dvec3& origin) {
    std::vector<Collider> out;
    for (int i = 0; i < 70; ++i)
        out.push_back(on(SphereCollider{origin + dvec3(0.25 * i, 0.01 * (i % 3), 0), 0.3}));
    return out;
}

Scene rain(const dvec3& origin) {
    std::vector<test::Item> items;
    for (int i = 0; i < 60; ++i)
        items.push_back(at(origin + dvec3(0.3 * i - 0.31, 1.3 + 0.01 * (i % 5), 0.03 * (i % 4))));
    Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
    scene.gravity = {0, -9.81, 0};
    test::setSteps(scene, 1 / 60.0, 4);
    return scene;
}

// m: the furthest that some point of the one scene is from its like in the other, `way` from there.
double apart(const Scene& near, const Scene& far, const dvec3& way, int frames) {
    Snapshot states[2];
    for (const int i : {0, 1}) {
        Simulation simulation = test::simulationOf(i == 0 ? near : far);
        test::run(simulation, frames);
        states[i] = simulation.snapshot(0);
    }
    double out = 0;
    for (size_t i = 0; i < states[0].positions.size(); ++i)
        out = std::max(out, glm::distance(states[0].positions[i], states[1].positions[i] - way));
    return out;
}

}  // namespace

TEST_CASE("colliders 100 km out stand where they say", "[numerics][contact][far]") {
    using Make = std::vector<Collider> (*)(const dvec3&);
    const Make make[] = {colliders, manySpheres,
                         [](const dvec3& origin) { return std::vector<Collider>{on(slope(origin))}; },
                         [](const dvec3& origin) { return std::vector<Collider>{on(bumps(origin))}; }};
    for (size_t kind = 0; kind < std::size(make); ++kind) {
        const dvec3& way = kind == 3 ? level : away;
        Scene near = rain(dvec3(0)), far = rain(way);
        near.colliders = make[kind](dvec3(0));
        far.colliders = make[kind](way);
        CAPTURE(kind);
        CHECK(apart(near, far, way, 40) < 2e-5);  // roundings of 1e-7, over a few bounces
    }
}

TEST_CASE("fields and forces 100 km out have their origins where they say", "[numerics][far]") {
    const auto scene = [](const dvec3& origin) {
        Scene out = rain(origin);
        out.groups[0].drag = {2, 2};
        VortexField vortex;
        vortex.origin = origin + dvec3(8.1, 0, 0.3);
        Field field;
        field.shape = vortex;
        field.box = Box{origin + dvec3(-1, 0.9, -1), origin + dvec3(20.1, 2, 1)};
        out.fields = {field};
        Force pull;
        AttractForce attract;
        attract.position = origin + dvec3(5.2, 1, 0.4);
        attract.most = 20;
        pull.shape = attract;
        pull.path = ForcePath{{{0, {}, 1}, {1, {2.1, 0, 0}, 2}}, false};
        Force whirl;
        whirl.shape = VortexLineForce{.position = origin + dvec3(12.7, 0, 0.2)};
        out.forces = {pull, whirl};
        return out;
    };
    CHECK(apart(scene(dvec3(0)), scene(away), away, 30) < 5e-6);
}

TEST_CASE("the box that molecules live in is where it says 100 km out", "[births][far]") {
    if (!test::canSpawn()) return;
    std::vector<bool> alive[2];
    for (const int i : {0, 1}) {
        const dvec3 origin = i == 0 ? dvec3(0) : away;
        std::vector<test::Item> items;
        for (int n = 0; n < 40; ++n)
            items.push_back(at(origin + dvec3(0, 0.00025 + 0.0005 * n, 0)));  // none is on the border
        Scene scene = test::sceneOf(test::point(1), SolverKind::leapfrog, items);
        Lifecycle& life = scene.groups[0].life.emplace();
        life.capacity = 40;
        life.life = glm::dvec2(10);
        life.within = Box{origin + dvec3(-1, 0.01, -1), origin + dvec3(1, 1, 1)};
        Simulation simulation = test::simulationOf(scene);
        simulation.frame();
        alive[i] = simulation.snapshot(0).alive;
    }
    CHECK(std::count(alive[0].begin(), alive[0].end(), true) == 20);
    CHECK(alive[1] == alive[0]);
}

}  // namespace shoal
