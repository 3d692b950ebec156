// Contact as the passes do it: advance, then `respond` at the end of every step, for both solvers' drifts.
// The answers are closed forms that know no step: a bounce reaches e^2 of its height, a slope slides at
// g (sin a - mu cos a).
#include <cmath>
#include <numbers>
#include <optional>

#include "support/catch.h"
#include "support/shader_physics.h"

namespace shoal {

using glm::vec3;
using shader::Contact;
using shader::Drift;

namespace {

enum class Method { euler, leapfrog };

Drift driftOf(Method method, float h, const vec3& acceleration) {
    return method == Method::euler ? Drift{h, h, h / 2, acceleration} : Drift{h, h / 2, 0, acceleration};
}

struct Surface {
    vec3 normal{0, 1, 0};
    float restitution = 0, friction = 0;
};

// A point under gravity above (or on) a plane through the origin.
struct Fall {
    Method method;
    float h;
    vec3 gravity;
    Surface surface;
    vec3 x{0}, v{0};

    void step() {
        if (method == Method::euler) {
            v += h * gravity;
            x += h * v;
        } else {
            const vec3 before = v;
            v += h * gravity;
            x += (before + v) * (h / 2);
        }
        const Contact after =
            shader::respond(false, x, v, glm::dot(x, surface.normal), surface.normal, surface.restitution,
                            surface.friction, driftOf(method, h, gravity));
        x = after.position;
        v = after.velocity;
    }
};

// Height of the first bounce: the highest sample's parabola, exact for ballistic motion.
double bounceHeight(Fall fall, int most) {
    bool hit = false;
    double best = 0;
    for (int i = 0; i < most; ++i) {
        const float before = fall.v.y;
        fall.step();
        if (!hit) {
            hit = before < 0 && (fall.v.y >= 0 || fall.v.y > before + 1e-4f);
        } else if (fall.v.y < 0 || before < 0) {
            break;
        }
        if (!hit) continue;
        // the velocity that goes with the position: half a step later for euler
        const double lag = fall.method == Method::euler ? 0.5 * fall.h : 0;
        const double v = fall.v.y + fall.gravity.y * lag;
        best = std::max(best, fall.x.y + (v > 0 ? v * v / (2 * -double(fall.gravity.y)) : 0));
    }
    REQUIRE(hit);
    return best;
}

constexpr float g = 9.81f;

}  // namespace

TEST_CASE("a bounce reaches e^2 of its height at every phase within a step", "[contact]") {
    for (Method method : {Method::euler, Method::leapfrog}) {
        for (float h : {1 / 60.0f, 1 / 240.0f, 1 / 1000.0f}) {
            for (float e : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
                double worst = 0;
                for (int phase = 0; phase < 16; ++phase) {
                    // dropped from rest at 1 m: the phases shift the drop by up to the last step's way
                    const float drop = 1 + float(phase) / 16 * std::sqrt(2 * g) * h;
                    Fall fall{method, h, {0, -g, 0}, {.restitution = e}, {0, drop, 0}, {0, 0, 0}};
                    // euler's first velocity stands half a step before its position
                    if (method == Method::euler) fall.v.y = g * h / 2;
                    const double height = bounceHeight(fall, int(4 / h));
                    worst = std::max(worst, std::abs(height / drop - e * e));
                }
                INFO((method == Method::euler ? "euler" : "leapfrog") << " h 1/" << 1 / h << " e " << e);
                CHECK(worst < 0.02 * std::max(e * e, 0.05f));
            }
        }
    }
}

TEST_CASE("bouncing undamped for long neither gains nor loses", "[contact]") {
    for (Method method : {Method::euler, Method::leapfrog}) {
        Fall fall{method, 1 / 240.0f, {0, -g, 0}, {.restitution = 1}, {0, 1, 0}, {0, 0, 0}};
        double high = 0;
        for (int i = 0; i < 240 * 60; ++i) {
            fall.step();
            if (i > 240 * 58) high = std::max(high, double(fall.x.y));
        }
        CHECK(high == Approx(1).margin(0.05));
    }
}

TEST_CASE("friction does not change a bounce's height and stops at mu times the impulse", "[contact]") {
    for (Method method : {Method::euler, Method::leapfrog}) {
        const float h = 1 / 240.0f, e = 0.5f;
        Fall smooth{method, h, {0, -g, 0}, {.restitution = e, .friction = 0}, {0, 1, 0}, {3, 0, 0}};
        Fall rough = smooth;
        rough.surface.friction = 0.3f;
        CHECK(bounceHeight(rough, 1000) == Approx(bounceHeight(smooth, 1000)).epsilon(1e-6));
        const float impact = std::sqrt(2 * g);
        int steps = 0;
        while (rough.v.x == 3 && ++steps < 1000)
            rough.step();
        CHECK(3 - rough.v.x == Approx(0.3 * (1 + e) * impact).epsilon(0.01));
        // a smooth surface takes nothing
        for (int i = 0; i < 1000; ++i)
            smooth.step();
        CHECK(smooth.v.x == 3);
    }
}

TEST_CASE("a resting contact stays at rest without jitter", "[contact]") {
    for (Method method : {Method::euler, Method::leapfrog}) {
        for (float e : {0.0f, 0.2f, 0.5f, 0.9f}) {
            for (float h : {1 / 60.0f, 1 / 240.0f, 1 / 1000.0f}) {
                INFO((method == Method::euler ? "euler" : "leapfrog") << " h 1/" << 1 / h << " e " << e);
                Fall fall{method,        h,           {0, -g, 0}, {.restitution = e, .friction = 0.5f},
                          {0, 0.01f, 0}, {0.2f, 0, 0}};
                // bounces of 1 cm die out after 2 t e / (1 - e), t = 45 ms
                const float end = 1 + 0.09f * e / (1 - e);
                for (int i = 0; i < int(end / h); ++i)
                    fall.step();
                CHECK(glm::length(fall.v) == 0);
                const vec3 place = fall.x;
                CHECK(std::abs(place.y) < 1.1e-6f);  // restingSlack
                for (int i = 0; i < 1000; ++i)
                    fall.step();
                CHECK(fall.x == place);
                CHECK(glm::length(fall.v) == 0);
            }
        }
    }
}

TEST_CASE("a slope slides at g (sin a - mu cos a) and holds below atan mu", "[contact]") {
    const float mu = 0.5f;
    for (Method method : {Method::euler, Method::leapfrog}) {
        for (float h : {1 / 60.0f, 1 / 240.0f, 1 / 1000.0f}) {
            for (float degrees : {10.0f, 20.0f, 26.0f, 27.5f, 35.0f, 60.0f}) {
                for (float e : {0.0f, 0.4f}) {
                    INFO((method == Method::euler ? "euler" : "leapfrog")
                         << " h 1/" << 1 / h << " angle " << degrees << " e " << e);
                    const float a = degrees * std::numbers::pi_v<float> / 180;
                    Fall fall{method, h, {0, -g, 0}, {{std::sin(a), std::cos(a), 0}, e, mu}};
                    const int steps = int(std::lround(2 / h));
                    for (int i = 0; i < steps; ++i)
                        fall.step();
                    const double time = steps * double(h);
                    const double slide = g * (std::sin(a) - mu * std::cos(a));
                    const vec3 down(std::cos(a), -std::sin(a), 0);
                    CHECK(std::abs(glm::dot(fall.x, fall.surface.normal)) < 1e-4f);
                    if (slide <= 0) {
                        CHECK(glm::length(fall.x) < 1e-6f);
                        continue;
                    }
                    CHECK(glm::dot(fall.v, down) / time == Approx(slide).epsilon(0.01));
                    // the position has a first-order offset of one step's speed at most
                    CHECK(glm::dot(fall.x, down) == Approx(slide * time * time / 2).epsilon(0.01 + h / time));
                }
            }
        }
    }
}

TEST_CASE("contact leaves alone what is outside or on its way out", "[contact]") {
    const Drift drift{0.01f, 0.01f, 0.005f, {0, -g, 0}};
    const Contact outside =
        shader::respond(false, {1, 0.1f, 2}, {3, -4, 5}, 0.1f, {0, 1, 0}, 0.5f, 0.5f, drift);
    CHECK(outside.position == vec3(1, 0.1f, 2));
    CHECK(outside.velocity == vec3(3, -4, 5));
    const Contact leaving =
        shader::respond(false, {1, -0.03f, 2}, {3, 4, 5}, -0.03f, {0, 1, 0}, 0.5f, 0.5f, drift);
    CHECK(leaving.velocity == vec3(3, 4, 5));
    CHECK(leaving.position.y == Approx(0).margin(1e-7));
}

TEST_CASE("contact as a constraint: the velocity is what the moved position leaves", "[contact]") {
    const float h = 1 / 240.0f;
    const glm::vec3 n(0, 1, 0);
    for (const float mu : {0.0f, 0.5f, 100.0f}) {
        const glm::vec3 x(1, -0.01f, 2), v(3, -4, -1);
        const Contact after = shader::constrain(false, x, v, -0.01f, n, mu, h);
        INFO("mu " << mu);
        CHECK(after.position.y == Approx(0).margin(1e-7));
        CHECK(glm::length(after.velocity - (v + (after.position - x) / h)) < 1e-3f);  // roundings of 1e-7 m
        // a depth of 0.01 m is 2.4 m/s: so much, times mu, goes along the surface, at most all of it
        const float speed = std::sqrt(10.0f), left = std::max(0.0f, speed - mu * 2.4f);
        CHECK(after.velocity.y == Approx(-1.6).margin(1e-4));
        CHECK(glm::length(glm::vec2(after.velocity.x, after.velocity.z)) == Approx(left).margin(1e-4));
    }
    // outside nothing happens
    CHECK(shader::constrain(false, {1, 0.1f, 2}, {3, -4, 5}, 0.1f, n, 0.5f, h).velocity ==
          glm::vec3(3, -4, 5));
    // caught deep inside: out at pushSpeed, and no faster
    const Contact caught = shader::constrain(false, {0, -2, 0}, {0, 0, 0}, -2, n, 0.5f, h);
    CHECK(caught.velocity.y == Approx(1));
    CHECK(shader::constrain(false, {0, -2, 0}, {0, 1, 0}, -2, n, 0.5f, h).velocity.y == Approx(1));
    // a depth of g h^2 holds against gravity, and what began on the surface goes back to the bit
    const glm::vec3 start(0.3f, 0, 0.7f), pressed(0.01f, -9.81f * h, 0);
    const glm::vec3 end = start + pressed * h;
    const Contact rests = shader::constrain(false, end, pressed, end.y, n, 0.5f, h);
    CHECK(rests.velocity == glm::vec3(0));
    CHECK(glm::length(rests.position - start) < 1e-7f);
}

TEST_CASE("what rests is held while the reaction stays within Coulomb's cone", "[contact]") {
    const glm::vec3 n(0, 1, 0);
    const float mu = 0.5f;
    CHECK(shader::heldBy(n, mu, {0, -g, 0}) == glm::vec3(0));
    CHECK(shader::heldBy(n, mu, {3, -10, -3.9f}) == glm::vec3(0));        // 4.92 of 5
    CHECK(shader::heldBy(n, mu, {3, -10, -4.1f}) != glm::vec3(0));        // 5.08
    CHECK(shader::heldBy(n, mu, {0, 0.1f, 0}) == glm::vec3(0, 0.1f, 0));  // lifted
    CHECK(shader::heldBy(n, 0, {0, -g, 0}) == glm::vec3(0));
    CHECK(shader::heldBy(n, -1, {0, -g, 0}) == glm::vec3(0, -g, 0));  // on nothing
}

}  // namespace shoal
