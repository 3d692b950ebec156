// Impacts of marbles in their order: rows, racks and gases keep their energy, and no cluster gains any.
#include <algorithm>
#include <numeric>
#include <random>

#include "gl/agreement.h"
#include "gl/marbles.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;
using glm::vec2;

namespace {

double energy(const reference::Sphere& sphere) {
    return glm::dot(sphere.velocity, sphere.velocity) / sphere.weight / 2;
}

double energyOf(const Simulation& simulation) {
    double sum = 0;
    for (const reference::Sphere& sphere : statesOf(simulation))
        sum += energy(sphere);
    return sum;
}

// Marbles of 0.1 m in a row along x, with gaps, and one that comes at 1 m/s.
Scene row(int count, double gap) {
    std::vector<dvec3> places = {{-0.5, 0, 0}};
    for (int i = 0; i < count; ++i)
        places.emplace_back(i * (0.2 + gap), 0, 0);
    return marbles(places, 0.1);
}

std::vector<dvec3> firstComes(size_t count) {
    std::vector<dvec3> out(count, dvec3(0));
    out[0].x = 1;
    return out;
}

}  // namespace

// Each strikes the next alone: it keeps (1 - e) / 2 of its speed, and hands on (1 + e) / 2.
TEST_CASE("a row of marbles hands on an impact from each to the next", "[impacts]") {
    const Path path = pathHere();
    const double gap = GENERATE(0.0, 0.0003, 0.0021, 0.0039, 0.0041);
    const double e = GENERATE(1.0, 0.9);
    const int count = 20;
    const Scene scene = row(count, gap);
    Simulation simulation = startedWith(scene, firstComes(count + 1), vec2(float(e), 0), path);
    test::run(simulation, 130);
    const Snapshot after = simulation.snapshot(0);
    double handed = 1, worst = 0;
    for (int i = 0; i <= count; ++i) {
        const double kept = i < count ? handed * (1 - e) / 2 : handed;
        worst = std::max(worst, std::abs(double(after.velocities[size_t(i)].x) - kept));
        handed *= (1 + e) / 2;
    }
    CAPTURE(name(path), gap, e, worst);
    // in narrow gaps those that keep a part of the speed strike one another again
    CHECK((worst < 1e-5 || (gap < 0.003 && e < 1)));
    CHECK(std::abs(after.velocities.back().x / std::pow((1 + e) / 2, count) - 1) < 0.02);
}

TEST_CASE("a marble that breaks a rack keeps its energy at any number of iterations", "[impacts]") {
    const Path path = pathHere();
    const int iterations = GENERATE(1, 4, 6, 8, 12);
    std::vector<dvec3> places = {{-0.4, 0.001, 0}};
    for (int i = 0; i < 5; ++i)
        for (int k = 0; k <= i; ++k)
            places.emplace_back(0.1 * std::sqrt(0.75) * i, 0.1 * k - 0.05 * i, 0);
    Scene scene = marbles(places, 0.05);
    scene.contact.iterations = iterations;
    for (const float e : {1.0f, 0.9f}) {
        Simulation simulation = startedWith(scene, firstComes(places.size()), vec2(e, 0), path);
        const double before = energyOf(simulation);
        double most = 1;
        for (int i = 0; i < 100; ++i) {
            simulation.frame();
            most = std::max(most, energyOf(simulation) / before);
        }
        const double after = energyOf(simulation) / before;
        CAPTURE(name(path), iterations, e, most, after);
        CHECK(most < 1 + 1e-5);
        if (e == 1) CHECK(after > 1 - 1e-4);
        if (e < 1) CHECK(after < 0.99);
        CHECK(glm::length(momentum(statesOf(simulation)) - dvec3(1, 0, 0)) < 1e-5);
    }
}

// 216 marbles fill a fifth of a room of smooth walls, elastic like them.
TEST_CASE("a gas of elastic marbles keeps its energy", "[impacts]") {
    const Path path = pathHere();
    const double radius = 0.05, side = std::cbrt(216 * 4 * 3.14159265 / 3 * radius * radius * radius / 0.2);
    std::vector<dvec3> places, velocities;
    std::mt19937 random(3);
    std::normal_distribution<double> speed(0, 0.5);
    for (int i = 0; i < 216; ++i) {
        places.push_back((dvec3(i % 6, i / 6 % 6, i / 36) + 0.5) * (side / 6));
        velocities.emplace_back(speed(random), speed(random), speed(random));
    }
    Scene scene = marbles(places, radius);
    for (int wall = 0; wall < 6; ++wall) {
        dvec3 point(0), inwards(0);
        inwards[wall / 2] = wall % 2 == 0 ? 1 : -1;
        if (wall % 2 == 1) point[wall / 2] = side;
        scene.colliders.push_back({.name = concat("wall ", wall),
                                   .shape = PlaneCollider{point, inwards},
                                   .restitution = 1,
                                   .friction = 0});
    }
    Simulation simulation = startedWith(scene, velocities, vec2(1, 0), path);
    const double before = energyOf(simulation);
    test::run(simulation, 300);
    const double after = energyOf(simulation) / before;
    CAPTURE(name(path), after);
    CHECK(std::abs(after - 1) < 0.01);
}

// Returns by how much of it a cloud of 343 marbles of 0.1 m without friction changes its angular momentum
// within 2 s. They spin at 1 rad/s, are `spacing` apart, and approach the middle at `inwards` times their
// distance from it, 1/s.
static double lostTurning(Path path, double e, double spacing, double inwards, int rate) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> off(-0.45, 0.45);
    std::normal_distribution<double> speed(0, 0.3);
    std::vector<dvec3> places, velocities;
    for (int i = 0; i < 343; ++i) {
        const dvec3 jitter = (spacing - 0.1) * dvec3(off(random), off(random), off(random));
        const dvec3 place = spacing * (dvec3(i % 7, i / 7 % 7, i / 49) - 3.0) + jitter;
        places.push_back(place);
        velocities.push_back(dvec3(speed(random), speed(random), speed(random)) - inwards * place +
                             glm::cross(dvec3(0, 0, 1), place));
    }
    Scene scene = marbles(places, 0.05);
    setSteps(scene, 1.0 / rate, 1);
    Simulation simulation = startedWith(scene, velocities, vec2(float(e), 0), path);
    const auto turning = [&] {
        dvec3 sum(0);
        for (const reference::Sphere& sphere : statesOf(simulation))
            sum += glm::cross(sphere.position, sphere.velocity) / sphere.weight;
        return sum;
    };
    const dvec3 before = turning();
    test::run(simulation, 2 * rate);
    return glm::distance(turning(), before) / glm::length(before);
}

// Impacts keep it. What overlaps in a crowd, because more impacts fall into a step than there are rounds,
// does not while it is pushed apart.
TEST_CASE("a cloud of marbles without friction keeps its angular momentum", "[impacts]") {
    const Path path = pathHere();
    const double e = GENERATE(1.0, 0.5, 0.0);
    if (path != Path::fused && e != 0.5) return;  // ten seconds
    const double gas = lostTurning(path, e, 0.25, 0.6, 100);
    const double crowd = lostTurning(path, e, 0.13, 3, 100), finer = lostTurning(path, e, 0.13, 3, 400);
    CAPTURE(name(path), e, gas, crowd, finer);
    CHECK(gas < 1e-6);
    CHECK(crowd < 0.03);
    CHECK(finer < 0.1 * crowd);
}

// In one step of contact, whatever they have for masses, friction, restitution and overlaps.
TEST_CASE("no cluster of marbles gains energy from an impact, or momentum", "[impacts]") {
    const Path path = pathHere();
    constexpr int clusters = 2500;
    const int iterations = GENERATE(1, 4, 8, 30);
    std::mt19937 random(unsigned(iterations) * 7);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    constexpr size_t masses = 7;
    Clusters built(masses);
    for (int c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 59);
        const double side = 0.2 * std::cbrt(count) * between(0.75, 1.3), heaviest = between(0, masses);
        const dvec3 corner(4 * (c % 50), 4 * (c / 50), 0);
        for (int i = 0; i < count; ++i) {
            const auto mass = size_t(between(0, heaviest));
            const dvec3 place = corner + dvec3(between(0, side), between(0, side), between(0, side));
            const dvec3 velocity(between(-1, 1), between(-1, 1), between(-1, 1));
            built.add(mass, place, velocity, size_t(c));
        }
    }
    Scene scene = built.scene(0.1, std::sqrt(10));
    const std::vector<size_t> owners = built.owners();
    scene.contact.iterations = iterations;
    const vec2 material(float(between(0, 1)), float(between(0, 1)));
    Simulation simulation = startedWith(scene, built.velocities(), material, path);
    const auto sums = [&] {
        std::vector<glm::dvec4> out(clusters, glm::dvec4(0));
        const std::vector<reference::Sphere> spheres = statesOf(simulation);
        for (size_t i = 0; i < spheres.size(); ++i)
            out[owners[i]] += glm::dvec4(spheres[i].velocity / spheres[i].weight, energy(spheres[i]));
        return out;
    };
    const std::vector<glm::dvec4> before = sums();
    simulation.frame();
    const std::vector<glm::dvec4> after = sums();
    double most = 0, lost = 0;
    for (size_t c = 0; c < clusters; ++c) {
        most = std::max(most, after[c].w / before[c].w);
        lost = std::max(lost, glm::length(dvec3(after[c]) - dvec3(before[c])) / std::sqrt(before[c].w));
    }
    CAPTURE(name(path), iterations, material.x, material.y, most, lost);
    CHECK(simulation.contact()->dropped() == 0);
    CHECK(most < 1 + 1e-5);
    CHECK(lost < 1e-4);
}

// The same of tetrahedra that move as rigid bodies, and of sheets whose triangles have spheres.
TEST_CASE("no cluster of bodies or sheets gains energy from an impact, or momentum", "[impacts]") {
    if (!canFuse()) return;
    const Path path = GENERATE(Path::fused, Path::fragments);
    const bool rigid = GENERATE(true, false);
    const int iterations = GENERATE(1, 4, 12);
    constexpr int clusters = 600;
    std::mt19937 random(unsigned(iterations) * 3 + rigid);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    Molecule molecule = rigid ? leaf(1e6, 0) : sheet(3, 3, false);
    if (rigid) {
        const dvec3 corners[] = {{0, 0, 0}, {0.5, 0, 0}, {0.25, 0, 0.43}, {0.25, 0.4, 0.14}};
        for (size_t i = 0; i < 4; ++i)
            molecule.vertices[i].position = corners[i];
    }
    for (Spring& spring : molecule.springs)
        spring.actuation.reset();
    std::vector<Item> items;
    std::vector<dvec3> velocities;
    std::vector<size_t> owners;
    const size_t vertices = molecule.vertices.size();
    for (int c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 7);
        const double side = 0.5 * std::cbrt(count) * between(0.7, 1.3);
        const dvec3 corner(6 * (c % 25), 6 * (c / 25), 0);
        for (int i = 0; i < count; ++i) {
            const glm::dquat turn(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
            items.push_back(at(corner + dvec3(between(0, side), between(0, side), between(0, side)),
                               glm::normalize(turn)));
            const dvec3 velocity(between(-1, 1), between(-1, 1), between(-1, 1));
            velocities.insert(velocities.end(), vertices, velocity);
            owners.push_back(size_t(c));
        }
    }
    Scene scene = sceneOf(molecule, rigid ? SolverKind::bdf2Xpbd : SolverKind::leapfrog, items);
    scene.groups[0].contact.emplace().radius = 0.1;
    scene.groups[0].contact->triangles = !rigid;
    scene.contact.iterations = iterations;
    setSteps(scene, 0.01, rigid ? 1 : 4);
    scene.contact.steps = 1;
    const bool elastic = GENERATE(false, true);
    const vec2 material = elastic ? vec2(1, 0) : vec2(float(between(0, 1)), float(between(0, 1)));
    Simulation simulation = startedWith(scene, velocities, material, path);
    REQUIRE(simulation.plan().groups[0].rigid == rigid);
    const auto sums = [&] {
        std::vector<glm::dvec4> out(clusters, glm::dvec4(0));
        const Snapshot snapshot = simulation.snapshot(0);
        for (size_t i = 0; i < snapshot.velocities.size(); ++i) {
            const dvec3 v = snapshot.velocities[i];
            const double mass = molecule.vertices[i % vertices].mass;
            out[owners[i / vertices]] += mass * glm::dvec4(v, glm::dot(v, v) / 2);
        }
        return out;
    };
    const std::vector<glm::dvec4> before = sums();
    simulation.frame();
    const std::vector<glm::dvec4> after = sums();
    double most = 0, least = 1, lost = 0;
    for (size_t c = 0; c < clusters; ++c) {
        most = std::max(most, after[c].w / before[c].w);
        least = std::min(least, after[c].w / before[c].w);
        lost = std::max(lost, glm::length(dvec3(after[c]) - dvec3(before[c])) / std::sqrt(before[c].w));
    }
    CAPTURE(name(path), rigid, iterations, material.x, material.y, most, least, lost);
    CHECK(simulation.contact()->dropped() == 0);
    CHECK(most < 1 + 1e-5);
    CHECK((least > 1 - 1e-5) == elastic);
    CHECK(lost < 1e-5);
}

// Four corners at once: one impact in their middle, by which neither turns, as two marbles have it.
TEST_CASE("a cube that strikes another flat does not turn", "[impacts]") {
    if (!canFuse()) return;
    const Path path = GENERATE(Path::fused, Path::fragments);
    Molecule cube = leaf(1e6, 0);
    cube.vertices.resize(8, cube.vertices[0]);
    cube.springs.resize(0);
    cube.triangles.resize(0);
    for (int i = 0; i < 8; ++i) {
        cube.vertices[size_t(i)].position = dvec3(i & 1, i >> 1 & 1, i >> 2) * 0.1;
        for (int k = 0; k < i; ++k)
            cube.springs.push_back({k, i, 1e6, 0, {}, {}});
    }
    Scene scene = sceneOf(cube, SolverKind::bdf2Xpbd, {at(dvec3(0)), at({0, 0.165, 0})});
    scene.groups[0].contact.emplace().radius = 0.03;
    setSteps(scene, 0.01, 1);
    std::vector<dvec3> velocities(8, dvec3(0.1, 0, 0));
    velocities.insert(velocities.end(), 8, dvec3(0.1, -1, 0));
    const double e = GENERATE(0.2, 0.9);
    Simulation simulation = startedWith(scene, velocities, vec2(float(e), 0), path);
    REQUIRE(simulation.plan().groups[0].rigid);
    simulation.frame();
    const Snapshot after = simulation.snapshot(0);
    double worst = 0;
    for (size_t i = 0; i < 16; ++i) {
        const dvec3 wanted = i < 8 ? dvec3(0.1, -(1 + e) / 2, 0) : dvec3(0.1, -(1 - e) / 2, 0);
        worst = std::max(worst, glm::distance(dvec3(after.velocities[i]), wanted));
    }
    CAPTURE(name(path), e, worst);
    CHECK(worst < 1e-5);
}

}  // namespace shoal
