// Waves and hurricanes against what is known of them in closed form. Derivatives are central differences of
// step e: off by e^2 / 6 of the third derivative, and by the rounding of a difference over e.
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "reference/fields.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

namespace shoal::reference {

using glm::dvec3;
using std::numbers::pi;

namespace {

constexpr double e = 1e-4;

template <typename Shape>
glm::dmat3 gradient(const Shape& shape, const dvec3& x, double time) {
    glm::dmat3 columns(0);  // column i: du / dx_i
    for (int i = 0; i < 3; ++i) {
        dvec3 step(0);
        step[i] = e;
        columns[i] = (fieldVelocity(shape, x + step, time) - fieldVelocity(shape, x - step, time)) / (2 * e);
    }
    return columns;
}

double divergence(const glm::dmat3& g) {
    return g[0][0] + g[1][1] + g[2][2];
}

dvec3 curl(const glm::dmat3& g) {
    return {g[1][2] - g[2][1], g[2][0] - g[0][2], g[0][1] - g[1][0]};
}

WavesField oneTrain(double amplitude, double wavelength, std::optional<double> depth = {}) {
    WavesField out;
    out.depth = depth;
    out.trains = {{{1, 0, 0}, amplitude, wavelength, 0}};
    return out;
}

dvec3 at(const FieldShape& shape, const dvec3& x, double time = 0) {
    return fieldVelocity(shape, x, time);
}

}  // namespace

TEST_CASE("deep water: circles whose radius falls as e^ky, at the speed of sqrt(g / k)",
          "[reference][waves]") {
    const double k = 2 * pi / 6, omega = std::sqrt(9.81 * k);
    const WavesField waves = oneTrain(0.2, 6);
    for (const double y : {0.0, -1.0, -3.0}) {
        const double speed = 0.2 * omega * std::exp(k * y);
        for (int i = 0; i < 8; ++i) {
            const double x = 0.7 * i, t = 0.3 * i, a = k * x - omega * t;
            const dvec3 u = at(waves, {x, y, 5}, t);
            CHECK(glm::length(u) == Approx(speed).epsilon(1e-12));
            CHECK(u.x == Approx(speed * std::cos(a)).margin(1e-12));
            CHECK(u.y == Approx(speed * std::sin(a)).margin(1e-12));
            CHECK(u.z == 0);
        }
    }
    // the surface is amplitude cos a: under a crest the water runs with the wave, ahead of it it rises
    CHECK(at(waves, {0, 0, 0}).x > 0);
    CHECK(at(waves, {1.5, 0, 0}).y > 0);
    // 40 wavelengths deep is as deep as without a bottom
    CHECK(glm::distance(at(oneTrain(0.2, 6, 240), {1, -1, 0}, 2), at(waves, {1, -1, 0}, 2)) < 1e-12);
}

TEST_CASE("shallow water: all of it moves to and fro, at the speed of sqrt(g h)", "[reference][waves]") {
    const double h = 0.05, length = 60, k = 2 * pi / length, omega = k * std::sqrt(9.81 * h);
    const WavesField waves = oneTrain(0.01, length, h);
    // to order (k h)^2 = 3e-5
    for (const double y : {0.0, -0.02, -h})
        for (int i = 0; i < 8; ++i) {
            const double x = 8.0 * i, t = 9.0 * i, a = k * x - omega * t;
            CHECK(at(waves, {x, y, 0}, t).x ==
                  Approx(0.01 * omega / (k * h) * std::cos(a)).margin(1e-4 * 0.2));
        }
    // ellipses flatten to lines at the bottom
    CHECK(std::abs(at(waves, {15, -h, 0}).y) < 1e-15);
    CHECK(at(waves, {15, 0, 0}).y == Approx(0.01 * omega).epsilon(1e-4));
    // below the bottom as at the bottom
    CHECK(at(waves, {3, -9, 0}) == at(waves, {3, -h, 0}));
}

TEST_CASE("waves are free of divergence and rotation, and their trains add up", "[reference][waves]") {
    WavesField waves = oneTrain(0.2, 6, 2.0);
    waves.trains.push_back({{-1, 0, 3}, 0.1, 2.5, 1});
    waves.trains.push_back({{0, 0, -1}, 0.4, 20, 2});
    waves.origin = {1, 3, 2};
    Random random(3, 0);
    for (int i = 0; i < 200; ++i) {
        const dvec3 x(10 * random.uniform(), 3 - 1.9 * random.uniform(), 10 * random.uniform());
        const double t = 20 * random.uniform();
        const glm::dmat3 g = gradient(waves, x, t);
        CHECK(std::abs(divergence(g)) < 1e-6);
        CHECK(glm::length(curl(g)) < 1e-6);
        dvec3 sum(0);
        for (const WaveTrain& train : waves.trains) {
            WavesField one = waves;
            one.trains = {train};
            sum += at(one, x, t);
        }
        CHECK(glm::distance(sum, at(waves, x, t)) < 1e-12);
    }
    // above the highest crest as at the highest crest
    CHECK(at(waves, {0, 99, 0}) == at(waves, {0, 3.7, 0}));
}

TEST_CASE("a hurricane's profile is Holland's", "[reference][hurricane]") {
    const HurricaneField storm{{0, 0, 0}, 50, 30, 1.5, 0, 15, 0};
    const auto speed = [&](double r) { return glm::length(at(storm, {r, 0, 0})); };
    CHECK(speed(30) == Approx(50).epsilon(1e-12));  // the peak, and where it is
    CHECK(speed(29) < 50);
    CHECK(speed(31) < 50);
    CHECK(speed(0) == 0);
    CHECK(speed(3) < 1e-3);
    const double s = std::pow(0.25, 1.5);
    CHECK(speed(120) == Approx(50 * std::sqrt(s * std::exp(1 - s))).epsilon(1e-12));
    // anticlockwise seen from above: at +x towards -z
    CHECK(at(storm, {30, 0, 0}).z == Approx(-50));
    HurricaneField southern = storm;
    southern.speed = -50;
    CHECK(at(southern, {30, 0, 0}).z == Approx(50));
    // gradient wind: v^2 / r + f v balances what v^2 / r does alone
    HurricaneField turning = storm;
    turning.coriolis = 0.7;
    const double v = glm::length(at(turning, {90, 0, 0}));
    CHECK(v * v / 90 + 0.7 * v == Approx(speed(90) * speed(90) / 90).epsilon(1e-12));
    // no wind above and below
    CHECK(at(storm, {30, 15.1, 0}) == dvec3(0));
    CHECK(at(storm, {30, -0.1, 0}) == dvec3(0));
}

TEST_CASE("a hurricane flows in below, rises in the eyewall, leaves above", "[reference][hurricane]") {
    const HurricaneField storm{{0, 0, 0}, 50, 30, 1.5, 0.35, 15, 0};
    const dvec3 ground = at(storm, {0, 0, 60});
    CHECK(ground.z < 0);
    CHECK(std::atan2(-ground.z, ground.x) == Approx(0.35));  // the angle of inflow
    CHECK(at(storm, {0, 14, 60}).z > 0);
    const auto rising = [&](double r) { return at(storm, {r, 7.5, 0}).y; };
    CHECK(rising(22) > 5 * rising(60));
    CHECK(rising(22) > 1000 * std::abs(rising(3)));
    CHECK(std::abs(at(storm, {22, 0, 0}).y) < 1e-12);
    CHECK(std::abs(at(storm, {22, 15, 0}).y) < 1e-12);
    HurricaneField turning = storm;
    turning.coriolis = 0.7;
    Random random(9, 0);
    for (int i = 0; i < 300; ++i) {
        const dvec3 x(80 * random.uniform() - 40, 0.1 + 14.8 * random.uniform(), 80 * random.uniform() - 40);
        // of gradients up to 5 / s
        CHECK(std::abs(divergence(gradient(storm, x, 0))) < 1e-6);
        CHECK(std::abs(divergence(gradient(turning, x, 0))) < 1e-6);
    }
}

}  // namespace shoal::reference
