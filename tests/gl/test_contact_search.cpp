// The search of contact between molecules against brute force, on every path.
#include <algorithm>

#include "gl/marbles.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;
using glm::vec2;

namespace {

// Whether the two are in contact, or miss it, by so little that rounding may tell otherwise.
bool isClose(const std::vector<reference::Sphere>& spheres, const std::pair<int, int>& pair) {
    const reference::Sphere &a = spheres[size_t(pair.first)], &b = spheres[size_t(pair.second)];
    return std::abs(glm::distance(a.position, b.position) - ContactPlan::near * (a.radius + b.radius)) <
           1e-6 * (a.radius + b.radius);
}

// Finds what brute force finds; nothing moves far in the 1e-5 s of the step.
void checkFound(const Scene& scene) {
    const Plan plan = compile(scene);
    const std::vector<reference::Sphere> spheres = spheresOf(plan);
    const Pairs expected = reference::touching(spheres);
    CHECK(expected.size() > 20);
    const Path path = pathHere();
    if (path == Path::pingPong && std::any_of(plan.contact.groups.begin(), plan.contact.groups.end(),
                                              [](const ContactGroup& g) { return g.triangles || g.self; }))
        return;
    Simulation simulation = simulationOn(path, plan);
    simulation.frame();
    const Pairs found = simulation.contact()->found();
    CHECK(simulation.contact()->dropped() == 0);
    for (const Pairs& difference : {missing(found, expected), missing(expected, found)})
        for (const auto& pair : difference)
            CHECK(isClose(spheres, pair));
}

}  // namespace

TEST_CASE("the exact search finds every contact", "[molecule contact]") {
    SECTION("one size") {
        checkFound(strewn(500, dvec3(2), 0.04));
    }
    SECTION("crowded") {
        checkFound(strewn(300, dvec3(0.6), 0.015));
    }
    SECTION("all in one plane") {
        checkFound(strewn(400, {4, 0, 4}, 0.05));
    }
    SECTION("radii that differ") {
        checkFound(strewn(500, dvec3(2), 0.03, {0.3, 2}));
    }
    SECTION("a little larger than one workgroup") {
        checkFound(strewn(33, dvec3(0.5), 0.05));
    }
    SECTION("few spheres in the smallest table") {
        checkFound(strewn(8, dvec3(0.2), 0.06));
    }
    SECTION("with spheres on triangles") {
        Scene scene = strewn(300, dvec3(1.5), 0.04);
        scene.groups[0].contact->triangles = true;
        checkFound(scene);
    }
    SECTION("two groups") {
        Scene scene = strewn(200, dvec3(1.2), 0.04);
        scene.groups.push_back(strewn(150, dvec3(1.2), 0.02).groups[0]);
        scene.groups[1].molecule = test::shippedMolecule("leaf");
        scene.groups[1].name = "leaves";
        checkFound(scene);
    }
    SECTION("far from the origin") {
        for (const double distance : {1e3, 1e4, 1e5, 1e6}) {
            CAPTURE(distance);
            Scene scene = strewn(500, dvec3(0.4), 0.04, {0.2, 0.2});
            const dvec3 corner(distance, -distance, distance);
            scene.groups[0].place.box = {corner, corner + 0.4};
            checkFound(scene);
        }
    }
}

TEST_CASE("UberFlow's searches find some of the contacts and nothing else", "[molecule contact]") {
    const Path path = pathHere();
    CAPTURE(name(path));
    Scene scene = strewn(600, dvec3(1.5), 0.04);
    size_t found[3] = {};
    for (const ContactSearch search :
         {ContactSearch::single, ContactSearch::staggered, ContactSearch::exact}) {
        scene.contact.search = search;
        Simulation simulation = simulationOn(path, compile(scene));
        simulation.frame();
        const Pairs pairs = simulation.contact()->found();
        found[size_t(search)] = pairs.size();
        const std::vector<reference::Sphere> spheres = spheresOf(compile(scene));
        for (const auto& pair : missing(reference::touching(spheres), pairs))
            CHECK(isClose(spheres, pair));
    }
    const size_t exact = found[size_t(ContactSearch::exact)];
    CHECK(found[size_t(ContactSearch::single)] > exact / 4);
    CHECK(found[size_t(ContactSearch::staggered)] > found[size_t(ContactSearch::single)]);
    CHECK(found[size_t(ContactSearch::staggered)] <= exact);
}

TEST_CASE("more contacts than a list holds are left out on both sides, and counted", "[molecule contact]") {
    const Path path = pathHere();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.03, 0.03);
    std::vector<dvec3> positions, velocities;
    for (int i = 0; i < 60; ++i) {
        positions.emplace_back(place(random), place(random), place(random));
        velocities.push_back(20.0 * positions.back());
    }
    Simulation simulation = startedWith(marbles(positions, 0.05), velocities, vec2(0.5f, 0.5f), path);
    const dvec3 start = momentum(statesOf(simulation));
    simulation.frame();
    const uint32_t dropped = simulation.contact()->dropped();
    CAPTURE(name(path), dropped);
    CHECK(dropped > 500);
    simulation.frame();
    CHECK(simulation.contact()->dropped() > dropped);
    const std::vector<reference::Sphere> after = statesOf(simulation);
    CHECK(glm::length(momentum(after) - start) < 1e-4);
    for (const reference::Sphere& sphere : after)
        CHECK(glm::length(sphere.velocity) < 100);
}

}  // namespace shoal
