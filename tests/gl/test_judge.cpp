// Contact against another method that has converged: projected Gauss-Seidel in double precision, a contact at
// a time [Jean and Moreau 1992, Unilaterality and dry friction in the dynamics of rigid body collections].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "gl/marbles.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;

namespace {

constexpr double radius = 0.1, step = 0.01, gravity = 9.81;  // m, s, m/s^2

struct Cluster {
    std::vector<reference::Sphere> spheres;
    std::vector<size_t> numbers;  // of the scene's

    // Whether the sweeps have converged, to `tolerance` of the fastest. Velocities become those after the
    // response.
    bool solve(double friction, double tolerance) {
        struct Pair {
            size_t a, b;
            dvec3 normal, impulse{0};
            double target;
        };
        std::vector<Pair> pairs;
        for (size_t a = 0; a < spheres.size(); ++a) {
            for (size_t b = a + 1; b < spheres.size(); ++b) {
                // contact sees the spheres at the end of the step
                const dvec3 apart = spheres[a].position - spheres[b].position +
                                    step * (spheres[a].velocity - spheres[b].velocity);
                const double distance = glm::length(apart);
                if (distance < 1.1 * 2 * radius)
                    pairs.push_back(
                        {a, b, apart / distance, dvec3(0), std::min(2 * radius - distance, 0.0) / step});
            }
        }
        for (int sweep = 0; sweep < 50000; ++sweep) {
            double fastest = 0, changed = 0;
            for (Pair& pair : pairs) {
                reference::Sphere &a = spheres[pair.a], &b = spheres[pair.b];
                const double weight = a.weight + b.weight;
                const dvec3 u = a.velocity - b.velocity;
                const double speed = glm::dot(u, pair.normal), before = glm::dot(pair.impulse, pair.normal);
                const double along = std::max(before + (pair.target - speed) / weight, 0.0);
                dvec3 across = pair.impulse - before * pair.normal - (u - speed * pair.normal) / weight;
                const double grip = glm::length(across);
                if (grip > friction * along) across *= friction * along / grip;
                const dvec3 gained = along * pair.normal + across - pair.impulse;
                pair.impulse += gained;
                a.velocity += gained * a.weight;
                b.velocity -= gained * b.weight;
                changed = std::max(changed, glm::length(gained) * weight);
                fastest = std::max({fastest, glm::length(a.velocity), glm::length(b.velocity)});
            }
            if (changed <= tolerance * fastest) return true;
        }
        return false;
    }
};

// m/s, weighted by mass.
double distanceOf(const std::vector<dvec3>& a, const std::vector<dvec3>& b, const Cluster& cluster) {
    double sum = 0, mass = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += glm::dot(a[i] - b[i], a[i] - b[i]) / cluster.spheres[i].weight;
        mass += 1 / cluster.spheres[i].weight;
    }
    return std::sqrt(sum / mass);
}

std::vector<dvec3> velocitiesOf(const Cluster& cluster) {
    std::vector<dvec3> out;
    for (const reference::Sphere& sphere : cluster.spheres)
        out.push_back(sphere.velocity);
    return out;
}

struct Errors {
    double median = 0, worst = 0;  // as a part of what contact changes
    size_t judged = 0;
};

// 100 clusters of 2 to 60 spheres that overlap and approach one another too slowly for an impact, whose
// masses differ by a factor of up to `ratio`: one step of contact.
Errors errorsOf(Path path, double ratio, double friction, int iterations) {
    constexpr size_t clusters = 100, masses = 4;
    std::mt19937 random(5);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    Clusters built(masses);
    for (size_t c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 59);
        const double side = 1.5 * radius * std::cbrt(count);
        for (int i = 0; i < count; ++i) {
            const size_t mass = random() % masses;
            const dvec3 place = dvec3(4 * double(c % 10), 4 * double(c / 10), 0) +
                                dvec3(between(0, side), between(0, side), between(0, side));
            const dvec3 velocity(between(-0.05, 0.05), between(-0.05, 0.05), between(-0.05, 0.05));
            built.add(mass, place, velocity, c);
        }
    }
    Scene scene = built.scene(radius, std::pow(ratio, 1.0 / (masses - 1)));
    const std::vector<size_t> owners = built.owners();
    setSteps(scene, step, 1);
    scene.gravity = {0, -gravity, 0};
    scene.contact.iterations = iterations;
    Simulation simulation = startedWith(scene, built.velocities(), glm::vec2(0, float(friction)), path);
    std::vector<Cluster> judged(clusters);
    const std::vector<reference::Sphere> before = statesOf(simulation);
    for (size_t i = 0; i < before.size(); ++i) {
        judged[owners[i]].spheres.push_back(before[i]);
        judged[owners[i]].numbers.push_back(i);
    }
    simulation.frame();
    CHECK(simulation.contact()->dropped() == 0);
    const std::vector<reference::Sphere> after = statesOf(simulation);
    std::vector<double> errors;
    for (Cluster& cluster : judged) {
        const std::vector<dvec3> started = velocitiesOf(cluster);
        std::vector<dvec3> found;
        for (const size_t i : cluster.numbers)
            found.push_back(after[i].velocity + dvec3(0, gravity * step, 0));
        if (!cluster.solve(friction, 1e-9)) continue;
        const std::vector<dvec3> right = velocitiesOf(cluster);
        const double changes = distanceOf(right, started, cluster);
        if (changes > 1e-4) errors.push_back(distanceOf(found, right, cluster) / changes);
    }
    std::sort(errors.begin(), errors.end());
    return {errors[errors.size() / 2], errors.back(), errors.size()};
}

}  // namespace

TEST_CASE("contact converges to what projected Gauss-Seidel does", "[molecule contact]") {
    const Path path = GENERATE(Catch::Generators::from_range(pathsHere()));
    struct Bound {
        double ratio, friction;
        int iterations;
        double median, worst;
    };
    const Bound bound = GENERATE(Bound{1, 0, 4, 0.25, 0.4}, Bound{1, 0, 16, 0.04, 0.08},
                                 Bound{1, 0, 64, 2e-4, 0.02}, Bound{1, 0.5, 64, 0.003, 0.05},
                                 Bound{100, 0, 64, 0.008, 0.3}, Bound{100, 0.5, 64, 0.04, 0.4});
    const Errors errors = errorsOf(path, bound.ratio, bound.friction, bound.iterations);
    CAPTURE(name(path), bound.ratio, bound.friction, bound.iterations);
    CHECK(errors.judged >= 97);
    CHECK(errors.median < bound.median);
    CHECK(errors.worst < bound.worst);
}

// The table of docs/contact-figures.md.
TEST_CASE("how far contact is from what projected Gauss-Seidel makes of it", "[.judge]") {
    for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
        for (const double friction : {0.0, 0.5, 1.0}) {
            std::printf("| %g | %g |", ratio, friction);
            for (const int iterations : {4, 8, 16, 32, 64}) {
                const Errors errors = errorsOf(pathsHere().front(), ratio, friction, iterations);
                std::printf(" %.2g, %.2g |", 100 * errors.median, 100 * errors.worst);
            }
            std::printf("\n");
            std::fflush(stdout);
        }
    }
}

}  // namespace shoal
