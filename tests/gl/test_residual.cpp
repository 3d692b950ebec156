// Iterations of contact end where the residual is small, and then stacks stand and heaps lie, whatever their
// masses.
#include <algorithm>
#include <cmath>
#include <random>

#include "gl/marbles.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using glm::dvec3;

namespace {

constexpr double radius = 0.05;

// Marbles on one another on a floor, every other `ratio` times as heavy as those between.
Scene tower(int count, double ratio) {
    Scene scene;
    for (int i = 0; i < count; ++i) {
        Scene part = marbles({{0, (2 * i + 1) * radius, 0}}, radius, i % 2 ? ratio : 1);
        part.groups[0].name = concat(i);
        scene.groups.push_back(part.groups[0]);
    }
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = 4;
    scene.colliders.push_back({.name = "floor", .shape = PlaneCollider(), .restitution = 0, .friction = 0.5});
    return scene;
}

Simulation started(const Scene& scene, Path path = pathHere()) {
    return startedWith(scene, std::vector<dvec3>(scene.groups.size(), dvec3(0)), {0, 0.5}, path);
}

// Four layers of marbles that fall into a box in disorder, every other one of all `ratio` times as heavy.
Scene heap(double ratio) {
    constexpr int wide = 4;
    constexpr double apart = 2.3 * radius, wall = wide * apart / 2;
    std::minstd_rand random(1);
    std::uniform_real_distribution<double> aside(-0.12 * radius, 0.12 * radius);
    std::vector<dvec3> places[2];
    for (int i = 0; i < wide * wide * wide; ++i) {
        const dvec3 cell(i % wide, i / (wide * wide), i / wide % wide);
        const dvec3 place = apart * (cell + 0.5) - dvec3(wall, 0, wall);
        places[random() % 2].push_back(place + dvec3(aside(random), aside(random), aside(random)));
    }
    Scene scene = marbles(places[0], radius), heavy = marbles(places[1], radius, ratio);
    heavy.groups[0].name = "heavy";
    scene.groups.push_back(heavy.groups[0]);
    scene.gravity = {0, -9.81, 0};
    scene.solver.substeps = 4;
    for (const dvec3 normal :
         {dvec3(0, 1, 0), dvec3(1, 0, 0), dvec3(-1, 0, 0), dvec3(0, 0, 1), dvec3(0, 0, -1)}) {
        PlaneCollider plane;
        plane.normal = normal;
        if (normal.y == 0) plane.point = -wall * normal;
        scene.colliders.push_back({.name = concat("plane ", scene.colliders.size()),
                                   .shape = plane,
                                   .restitution = 0,
                                   .friction = 0.5});
    }
    return scene;
}

struct Rest {
    double fastest = 0, deepest = 0;  // m/s; parts of the sum of the radii
};

Rest restOf(const Simulation& simulation) {
    Rest out;
    const std::vector<reference::Sphere> spheres = statesOf(simulation);
    for (size_t i = 0; i < spheres.size(); ++i) {
        out.fastest = std::max(out.fastest, glm::length(spheres[i].velocity));
        if (i == 0) continue;
        const double distance = glm::distance(spheres[i].position, spheres[i - 1].position);
        out.deepest = std::max(out.deepest, 1 - distance / (2 * radius));
    }
    return out;
}

}  // namespace

TEST_CASE("iterations end where the residual is small, and not before", "[molecule contact]") {
    const Path path = pathHere();
    const int most = GENERATE(1, 9, 16);
    Scene scene = tower(4, 1);
    scene.contact.iterations = most;
    Simulation simulation = started(scene, path);
    CAPTURE(name(path), most);
    int ended = 0, reached = 0;
    for (int i = 0; i < 120; ++i) {
        simulation.frame();
        const ContactConvergence after = simulation.contact()->convergence();
        CAPTURE(i, after.iterations);
        CHECK(after.iterations <= most);
        REQUIRE(after.residual.has_value() == (most > 1 || after.iterations == 0));
        if (most == 1) continue;
        if (after.iterations == most) {
            ++reached;
            continue;
        }
        ++ended;
        CHECK(*after.residual <= scene.contact.tolerance);
        CHECK((most - after.iterations) % 2 == 0);
    }
    if (most == 1) return;
    CHECK(reached > 0);  // while a load is taken up
    CHECK(ended > 60);
    CHECK(simulation.contact()->convergence().iterations == 2 + most % 2);
}

TEST_CASE("iterations in fragments end where those of compute shaders do", "[molecule contact][agreement]") {
    if (pathHere() != Path::fused) return;
    const Scene scene = tower(4, 3);
    Simulation compute = started(scene, Path::fused), fragments = started(scene, Path::fragments);
    for (int i = 0; i < 60; ++i) {
        compute.frame();
        fragments.frame();
        const ContactConvergence a = compute.contact()->convergence(), b = fragments.contact()->convergence();
        CAPTURE(i, a.iterations, b.iterations);
        REQUIRE(a.iterations == b.iterations);
        CHECK(*b.residual == Approx(*a.residual).epsilon(0.01).margin(scene.contact.tolerance));
    }
}

TEST_CASE("a smaller tolerance takes more iterations", "[molecule contact]") {
    Scene scene = tower(6, 10);
    scene.contact.iterations = 64;
    int taken[2] = {};
    for (const bool tight : {false, true}) {
        scene.contact.tolerance = tight ? 1e-5 : 1e-2;
        Simulation simulation = started(scene);
        for (int i = 0; i < 60; ++i) {
            simulation.frame();
            taken[tight] += simulation.contact()->convergence().iterations;
        }
    }
    CHECK(taken[1] > 2 * taken[0]);
}

TEST_CASE("a tower of light and heavy marbles rests", "[molecule contact][long]") {
    if (pathHere() == Path::pingPong) return;  // whose iterations know no colliders, and carry less
    struct Tower {
        int count;
        double ratio;
        int iterations;  // at most
        double taken;    // at rest, in the mean of frames, at most
    };
    const int usual = ContactPlan::iterationsFor(1, 0);
    const Tower each =
        GENERATE_COPY(Tower{20, 1, usual, 4}, Tower{2, 100, usual, 7}, Tower{2, 1000, 64, 20},
                      Tower{6, 1000, 128, 32}, Tower{20, 30, 64, 16}, Tower{20, 1000, 256, 256});
    if (each.iterations > usual && pathHere() != Path::fused) return;  // half a minute
    Scene scene = tower(each.count, each.ratio);
    scene.contact.iterations = each.iterations;
    Simulation simulation = started(scene);
    double fastest = 0, taken = 0;
    for (int i = 0; i < 300; ++i) {
        simulation.frame();
        if (i < 270) continue;
        fastest = std::max(fastest, restOf(simulation).fastest);
        taken += simulation.contact()->convergence().iterations / 30.0;
    }
    CAPTURE(each.count, each.ratio, each.iterations);
    CHECK(fastest < 1e-3);
    CHECK(restOf(simulation).deepest < 0.02);
    CHECK(taken <= each.taken);
}

// What contacts remember one by one is not in balance on a light marble between heavy ones: it must not act
// on it as a force, or the heap moves at centimetres a second. As many iterations as the masses take.
TEST_CASE("a heap of light and heavy marbles lies still", "[molecule contact]") {
    const Path path = pathHere();
    if (path == Path::pingPong) return;  // its iterations know no colliders
    const double ratio = GENERATE(1, 30, 100);
    Simulation simulation = startedWith(heap(ratio), std::vector<dvec3>(64, dvec3(0)), {0, 0.5}, path);
    double squares = 0;
    for (int i = 0; i < 180; ++i) {
        simulation.frame();
        if (i < 150) continue;
        const std::vector<reference::Sphere> spheres = statesOf(simulation);
        for (const reference::Sphere& sphere : spheres)
            squares += glm::dot(sphere.velocity, sphere.velocity) / (30.0 * double(spheres.size()));
    }
    CAPTURE(name(path), ratio);
    CHECK(std::sqrt(squares) < 5e-4);
}
