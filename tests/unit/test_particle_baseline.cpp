// The CPU's particle loop against closed forms.
#include <cmath>

#include "bench/particle_baseline.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::bench;
using glm::dvec3;

namespace {

constexpr double gamma_ = 0.7;
const dvec3 gravity(0, -9.81, 0), wind(2, 0, 0.5);

ParticleStep stepOf(double h) {
    ParticleStep out;
    out.h = h;
    out.gravity = gravity;
    out.wind = wind;
    out.drag = gamma_;
    return out;
}

// The velocity and the way after t, under constant force and drag.
dvec3 velocityAt(const dvec3& v, double t) {
    const dvec3 last = wind + gravity / gamma_;
    return last + (v - last) * std::exp(-gamma_ * t);
}
dvec3 wayAfter(const dvec3& v, double t) {
    const dvec3 last = wind + gravity / gamma_;
    return last * t + (v - last) * (-std::expm1(-gamma_ * t) / gamma_);
}

std::vector<Simd> kinds() {
    std::vector<Simd> out;
    for (const Simd simd : {Simd::scalar, Simd::avx2, Simd::avx512})
        if (available(simd)) out.push_back(simd);
    return out;
}

// After 1 s from a place and a velocity.
double errorAfter(Simd simd, int steps) {
    constexpr int count = 37;  // no multiple of any vector
    std::vector<glm::vec3> positions, velocities;
    for (int i = 0; i < count; ++i) {
        positions.emplace_back(0.1f * float(i), 1, -0.05f * float(i));
        velocities.emplace_back(1, 0.2f * float(i), -1);
    }
    ParticleBaseline baseline(count, simd, 2);
    baseline.set(positions, velocities);
    for (int i = 0; i < steps; ++i)
        baseline.step(stepOf(1.0 / steps));
    const auto particles = baseline.get();
    REQUIRE(particles.size() == size_t(count));
    double worst = 0;
    for (size_t i = 0; i < count; ++i) {
        const dvec3 v(velocities[i]), exact = dvec3(positions[i]) + wayAfter(v, 1);
        worst = std::max(worst, glm::length(dvec3(particles[i].position) - exact));
        CHECK(glm::length(dvec3(particles[i].velocity) - velocityAt(v, 1)) < 2e-5);
    }
    return worst;
}

HeightFieldCollider slope() {
    HeightFieldCollider out;
    out.columns = 5;
    out.rows = 4;
    out.low = {-2, -3};
    out.high = {2, 3};
    for (int row = 0; row < out.rows; ++row)
        for (int column = 0; column < out.columns; ++column)
            out.heights.push_back(0.5f * float(column) - 1);  // 0.5 x
    return out;
}

}  // namespace

TEST_CASE("the particle loop follows the closed form, with the square of the step", "[particle baseline]") {
    for (const Simd simd : kinds()) {
        INFO(name(simd));
        const double coarse = errorAfter(simd, 10), fine = errorAfter(simd, 20);
        CHECK(coarse > 1e-3);
        CHECK(coarse / fine == Approx(4).epsilon(0.05));
        CHECK(errorAfter(simd, 60) < 3e-4);
    }
}

TEST_CASE("the particle loop bounces off a slope as the mirror says", "[particle baseline]") {
    const HeightFieldCollider field = slope();
    const dvec3 normal = glm::normalize(dvec3(-0.5, 1, 0)), along = glm::normalize(dvec3(1, 0.5, 0));
    ParticleStep step;
    step.h = 0.001;
    step.heights = &field;
    step.restitution = 0.5;
    step.friction = 0.25;
    for (const Simd simd : kinds()) {
        INFO(name(simd));
        std::vector<glm::vec3> positions, velocities;
        for (int i = 0; i < 20; ++i) {  // just above; the others beside the field
            const float x = -1.9f + 0.19f * float(i);
            positions.emplace_back(x, 0.5f * x + 0.0005f, i % 2 == 0 ? 0.3f : 3.5f);
            velocities.emplace_back(0, -2, 0);
        }
        ParticleBaseline baseline(positions.size(), simd, 1);
        baseline.set(positions, velocities);
        baseline.step(step);
        const auto particles = baseline.get();
        for (size_t i = 0; i < particles.size(); ++i) {
            const dvec3 v(particles[i].velocity), x(particles[i].position);
            if (i % 2 == 1) {
                CHECK(v == dvec3(0, -2, 0));
                continue;
            }
            const dvec3 before(0, -2, 0);
            CHECK(glm::dot(v, normal) == Approx(-0.5 * glm::dot(before, normal)).epsilon(1e-5));
            CHECK(glm::dot(v, along) == Approx(0.75 * glm::dot(before, along)).epsilon(1e-5));
            CHECK(std::abs(x.y - 0.5 * x.x) < 1e-6);
        }
    }
}

TEST_CASE("particles of the loop are born and die, and stay packed", "[particle baseline]") {
    ParticleStep step = stepOf(0.01);
    step.births = 20;
    step.life = {0.05, 0.15};
    step.from = {dvec3(1, 2, 3), dvec3(1, 2, 3)};
    step.velocity = {0.5, 4, 0};
    for (const Simd simd : kinds()) {
        INFO(name(simd));
        ParticleBaseline baseline(1000, simd, 2);
        for (int i = 0; i < 60; ++i)
            baseline.step(step);
        const auto particles = baseline.get();
        // 20 a step for 10 steps on average; the variance of one newborn's number of steps is 8.3
        CHECK(std::abs(double(particles.size()) - 200) < 5 * std::sqrt(20 * 8.4));
        for (const auto& particle : particles) {
            CHECK(particle.age < particle.life);
            CHECK((particle.life >= 0.05f && particle.life <= 0.15f));
            // to the end of its first step without force, then whole steps
            const double flown = std::fmod(particle.age, step.h), t = particle.age - flown;
            const dvec3 exact = dvec3(1, 2, 3) + step.velocity * flown + wayAfter(step.velocity, t);
            CHECK(glm::length(dvec3(particle.position) - exact) < 1e-4);
        }
    }
    ParticleBaseline small(50, Simd::scalar, 2);
    for (int i = 0; i < 20; ++i)
        small.step(step);
    CHECK(small.count() <= 50);
}
