// The baseline of contact does what the reference does: all contacts, and the same equations.
#include <algorithm>
#include <random>

#include "bench/contact_baseline.h"
#include "reference/sphere_response.h"
#include "support/catch.h"

namespace shoal::bench {

using glm::dvec3;
using glm::vec3;

namespace {

constexpr float radius = 0.03f;
const std::vector<float> weights = {1, 4, 0, 2};  // of a molecule's vertices: one is held
constexpr ContactBaselineStep step = {0.01f, 0.1f, 0.5f, 0.4f, 4};

struct Swarm {
    GroupState state;
    std::vector<reference::Sphere> spheres;
};

// Molecules about half a metre wide, in a box with corners on both sides of the origin.
Swarm swarm(int molecules, float side) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-side / 2, side / 2), near(-0.25f, 0.25f), speed(-1.5f, 1.5f);
    const auto random3 = [&](auto& of) { return vec3(of(random), of(random), of(random)); };
    Swarm out;
    for (int m = 0; m < molecules; ++m) {
        out.state.anchors.push_back(glm::floor(random3(place) * 16.0f) / 16.0f);
        for (const float weight : weights) {
            const vec3 position = random3(near), velocity = random3(speed);
            out.state.positions.push_back(position);
            out.state.velocities.push_back(velocity);
            out.spheres.push_back({dvec3(out.state.anchors.back()) + dvec3(position), dvec3(velocity),
                                   double(radius), double(weight), m});
        }
    }
    return out;
}

}  // namespace

TEST_CASE("the baseline of contact finds what brute force finds", "[contact baseline]") {
    for (const int threads : {1, 2, 3}) {
        for (const float side : {0.5f, 1.5f, 4.0f}) {
            const Swarm s = swarm(side < 1 ? 150 : 500, side);
            ContactBaseline baseline(weights, int(s.state.anchors.size()), radius, threads);
            baseline.set(s.state);
            baseline.step(step);
            const auto expected = reference::touching(s.spheres);
            CAPTURE(threads, side, expected.size());
            CHECK(expected.size() > 20);
            CHECK(baseline.found() == expected);
        }
    }
}

TEST_CASE("few spheres in the baseline's smallest table", "[contact baseline]") {
    const Swarm s = swarm(3, 0.01f);
    ContactBaseline baseline(weights, 3, 0.2f, 2);
    baseline.set(s.state);
    baseline.step(step);
    std::vector<reference::Sphere> spheres = s.spheres;
    for (reference::Sphere& sphere : spheres)
        sphere.radius = 0.2;
    CHECK(baseline.found() == reference::touching(spheres));
}

// Nothing moves between the steps but what contact moves: the first has impacts, the others remember.
TEST_CASE("the baseline of contact responds as the reference", "[contact baseline]") {
    reference::SphereResponse settings;
    settings.stepTime = double(step.stepTime);
    settings.restSpeed = double(step.restSpeed);
    settings.restitution = double(step.restitution);
    settings.friction = double(step.friction);
    settings.iterations = step.iterations;
    for (const int threads : {1, 2}) {
        const Swarm s = swarm(500, 1.2f);
        std::vector<reference::Sphere> expected = s.spheres;
        reference::ContactMemory memory;
        ContactBaseline baseline(weights, 500, radius, threads);
        baseline.set(s.state);
        for (int number = 0; number < 4; ++number) {
            const auto contacts = reference::touching(expected);
            REQUIRE(contacts.size() > 300);
            reference::respond(expected, contacts, settings, memory);
            for (size_t i = 0; i < expected.size(); ++i)
                expected[i].velocity += expected[i].weight * memory.loads[i];
            baseline.step(step);
            GroupState found = s.state;
            baseline.get(found);
            double velocity = 0, position = 0, moved = 0;
            for (size_t i = 0; i < expected.size(); ++i) {
                const dvec3 at = dvec3(found.anchors[i / weights.size()]) + dvec3(found.positions[i]);
                velocity =
                    std::max(velocity, glm::distance(dvec3(found.velocities[i]), expected[i].velocity));
                position = std::max(position, glm::distance(at, expected[i].position));
                moved = std::max(moved, glm::distance(s.spheres[i].velocity, expected[i].velocity));
            }
            CAPTURE(threads, number, velocity, position);
            CHECK(moved > 1);
            CHECK(velocity <
                  1e-3);  // of up to 5 m/s: a grazing contact's normal is a root of rounded numbers
            CHECK(position < 1e-5);
        }
    }
}

TEST_CASE("the baseline of contact forgets with another state", "[contact baseline]") {
    const Swarm s = swarm(200, 0.7f);
    ContactBaseline baseline(weights, 200, radius, 2);
    GroupState once = s.state, again = s.state;
    baseline.set(s.state);
    baseline.step(step);
    baseline.get(once);
    baseline.step(step);
    baseline.set(s.state);
    baseline.step(step);
    baseline.get(again);
    CHECK(once.velocities == again.velocities);
    CHECK(once.positions == again.positions);
}

}  // namespace shoal::bench
