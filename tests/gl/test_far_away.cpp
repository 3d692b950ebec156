// Far from the origin the scene's own geometry is as good as the molecules': what happens there is what
// happens at the origin.
#include <algorithm>

#include "gl/births.h"
#include "gl/numerics.h"
#include "reference/fields.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "support/catch.h"
#include "support/colliders.h"

namespace shoal {

using glm::dvec3;
using test::at;

namespace {

// m. At 1,000 km floats are 6 cm apart.
constexpr double distances[] = {1, 10, 100, 1e3, 1e4, 1e5, 1e6};

dvec3 away(double distance) {
    return distance * dvec3(1.000003, 0.999997, -0.777771);
}

HeightFieldCollider bumps(const dvec3& origin) {
    HeightFieldCollider out;
    out.columns = out.rows = 9;
    out.level = origin.y;
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

// The same plane, by a point of it that is a long way off.
PlaneCollider longSlope(const dvec3& origin) {
    PlaneCollider out = slope(origin);
    out.point -= glm::length(origin) * glm::normalize(glm::cross(out.normal, dvec3(0.3, 0.2, 1)));
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

TEST_CASE("colliders far out stand where they say", "[numerics][contact][far]") {
    using Make = std::vector<Collider> (*)(const dvec3&);
    const Make make[] = {colliders, manySpheres,
                         [](const dvec3& origin) { return std::vector<Collider>{on(slope(origin))}; },
                         [](const dvec3& origin) { return std::vector<Collider>{on(longSlope(origin))}; },
                         [](const dvec3& origin) { return std::vector<Collider>{on(bumps(origin))}; }};
    for (size_t kind = 0; kind < std::size(make); ++kind) {
        Scene near = rain(dvec3(0));
        near.colliders = make[kind](dvec3(0));
        for (const double distance : distances) {
            const dvec3 way = away(distance);
            Scene far = rain(way);
            far.colliders = make[kind](way);
            CAPTURE(kind, distance);
            CHECK(apart(near, far, way, 40) < 2e-5);  // roundings of 1e-7, over a few bounces
        }
    }
}

TEST_CASE("fields and forces far out have their origins where they say", "[numerics][far]") {
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
    for (const double distance : distances) {
        CAPTURE(distance);
        CHECK(apart(scene(dvec3(0)), scene(away(distance)), away(distance), 30) < 5e-6);
    }
}

// The fields that have no origin, or that one may leave at the scene's.
TEST_CASE("what repeats or is linear is as good far from the fields' origin as at it", "[numerics][far]") {
    const auto fields = [](const dvec3& place) {
        ShearField shear;
        shear.gradient = glm::dmat3(0.5, 1, -0.3, 0.2, -0.5, 0.7, 1.1, 0.4, -0.1);
        shear.velocity = -(shear.gradient * place);
        GridField grid;
        grid.resolution = {3, 2, 2}, grid.low = dvec3(-1), grid.high = {0.7, 0.1, 0.5}, grid.wrap = true;
        for (int i = 0; i < 12; ++i)
            grid.values.emplace_back(i % 3, i % 5, i % 7);
        WavesField waves;  // whose surface is everywhere: of its origin only x and z count
        waves.origin.y = place.y;
        waves.trains = {{.direction = {0.6, 0, 0.8}, .amplitude = 0.1, .wavelength = 1.3}};
        const GustField gust{.direction = {0.6, 0.2, 0.8}, .length = 2, .width = 1.5, .seed = 3};
        GustField computedGust = gust;
        computedGust.noise = NoiseForm::computed;
        const CurlNoiseField curl{.length = 1.1, .octaves = 2, .seed = 5};
        CurlNoiseField computedCurl = curl;
        computedCurl.noise = NoiseForm::computed;
        return std::vector<FieldShape>{shear,
                                       grid,
                                       waves,
                                       gust,
                                       computedGust,
                                       curl,
                                       computedCurl,
                                       AbcField{.wavelength = 1.7},
                                       TaylorGreenField{.wavelength = 1.9}};
    };
    // m/s: the most that a velocity is off where drag gives what floats the fluid's at once.
    const auto errorAt = [&](const dvec3& place, size_t kind) {
        Scene scene = rain(place);
        scene.gravity = dvec3(0);
        test::setSteps(scene, 1e-5, 1);
        scene.groups[0].drag = {1e8, 1e8};
        scene.fields.resize(1);
        scene.fields[0].shape = fields(place)[kind];
        Simulation simulation = test::simulationOf(scene);
        simulation.frame();
        const Snapshot state = simulation.snapshot(0);
        double out = 0;
        for (size_t i = 0; i < state.positions.size(); ++i)
            out = std::max(
                out, glm::distance(state.velocities[i],
                                   reference::fluidVelocity(scene.fields, state.positions[i], state.time)));
        return out;
    };
    for (size_t kind = 0; kind < fields(dvec3(0)).size(); ++kind) {
        const double near = errorAt(dvec3(0), kind);
        for (const double distance : distances) {
            CAPTURE(kindName(fields(dvec3(0))[kind]), kind, distance, near);
            CHECK(errorAt(away(distance), kind) < 2 * near + 1e-4);
        }
    }
}

// Marbles of 5 cm fall on a box and on one another.
TEST_CASE("a pile far out lies as one at the origin", "[molecule contact][far]") {
    constexpr double radius = 0.025;
    // of the radius: the most that two overlap, and the least gap above a stack of two
    const auto measure = [&](const dvec3& origin) {
        std::vector<test::Item> items = {at(origin + dvec3(2, 0.026, 0)), at(origin + dvec3(2, 0.085, 0))};
        for (int i = 0; i < 60; ++i)
            items.push_back(at(origin + dvec3(0.051 * (i % 4) + 0.003 * (i % 7), 0.03 + 0.055 * (i / 16),
                                              0.051 * (i / 4 % 4) + 0.003 * (i % 5))));
        Scene scene = test::sceneOf(test::point(0.01), SolverKind::leapfrog, items);
        scene.gravity = {0, -9.81, 0};
        scene.contact.iterations = 8;
        test::setSteps(scene, 1 / 60.0, 8);
        scene.groups[0].contact.emplace().radius = radius;
        scene.groups[0].friction = 0.9;
        scene.groups[0].restitution = 0;
        Collider floor = on(BoxCollider{origin + dvec3(0, -0.5, 0), {60, 1, 60}});
        floor.restitution = 0, floor.friction = 0.9;
        scene.colliders = {floor};
        Simulation simulation = test::simulationOf(scene);
        test::run(simulation, 120);
        const std::vector<dvec3> places = simulation.snapshot(0).positions;
        double overlap = 0;
        for (size_t a = 0; a < places.size(); ++a)
            for (size_t b = 0; b < a; ++b)
                overlap = std::max(overlap, 2 - glm::distance(places[a], places[b]) / radius);
        return glm::dvec2(overlap, glm::distance(places[0], places[1]) / radius - 2);
    };
    const glm::dvec2 near = measure(dvec3(0));
    CHECK(std::abs(near.y) < 0.03);  // ping-pong has no collider in the iterations
    for (const double distance : distances) {
        const glm::dvec2 far = measure(away(distance));
        CAPTURE(distance, near.x, far.x, near.y, far.y);
        CHECK(far.x < near.x + 0.01);
        CHECK(std::abs(far.y - near.y) < 0.001);
    }
}

TEST_CASE("the box that molecules live in is where it says far out", "[births][far]") {
    if (!test::canSpawn()) return;
    const auto aliveAt = [](const dvec3& origin) {
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
        return simulation.snapshot(0).alive;
    };
    const std::vector<bool> near = aliveAt(dvec3(0));
    CHECK(std::count(near.begin(), near.end(), true) == 20);
    for (const double distance : distances) {
        CAPTURE(distance);
        CHECK(aliveAt(away(distance)) == near);
    }
}

}  // namespace shoal
