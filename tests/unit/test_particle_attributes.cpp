// shaders/particles/attributes.glsl as C++: the text that the GPU runs, against closed forms.
#include <cmath>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/particle.h"
#include "support/catch.h"

// GLSL converts and shadows as it likes; the project's own C++ does not.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-declarations"
namespace shoal::particles {
using namespace glm;
namespace {
#include "particles/attributes.glsl"
}  // namespace
}  // namespace shoal::particles
#pragma GCC diagnostic pop

using namespace shoal::particles;

namespace {

bool near(const vec4& a, const vec4& b) {
    return glm::length(a - b) < 1e-5f;
}

glm::quat quatOf(const vec4& q) {
    return {q.w, q.x, q.y, q.z};
}

}  // namespace

TEST_CASE("colours: straight lines between keyframes", "[particle]") {
    const vec4 key[] = {{1, 0, 0, 1}, {0, 2, 0, 0.5f}, {0, 0, 3, 1}, {1, 1, 1, 0}};
    const float age[] = {0.1f, 0.15f, 0.6f, 1};
    const vec3 begins(age[0], age[1], age[2]);
    const vec3 perAge = 1.0f / (vec3(age[1], age[2], age[3]) - begins);
    const auto at = [&](float a) {
        return colorAt(a, key[0], key[1] - key[0], key[2] - key[1], key[3] - key[2], begins, perAge);
    };
    for (int i = 0; i < 4; ++i)
        CHECK(near(at(age[i]), key[i]));
    for (int i = 0; i < 3; ++i)
        for (const float share : {0.25f, 0.5f, 0.9f})
            CHECK(near(at(mix(age[i], age[i + 1], share)), mix(key[i], key[i + 1], share)));
    CHECK(near(at(0), key[0]));
    // A piece that is not there changes nothing.
    CHECK(near(colorAt(1, key[0], key[1] - key[0], vec4(9), vec4(9), vec3(0), vec3(2, 0, 0)), key[1]));
}

TEST_CASE("keyframes become pieces", "[particle]") {
    using shoal::ColorKey;
    const std::vector<ColorKey> keys = {{0, {1, 0, 0}, 1}, {0.25, {0, 2, 0}, 0.5}, {1, {0, 0, 1}, 0.2}};
    const shoal::ColorPieces pieces = shoal::colorPieces(keys);
    const auto at = [&](float age) {
        return colorAt(age, pieces.first, pieces.changes[0], pieces.changes[1], pieces.changes[2],
                       pieces.begins, pieces.perAge);
    };
    for (const ColorKey& key : keys)
        CHECK(near(at(float(key.age)), vec4(vec3(key.color), float(key.opacity))));
    CHECK(near(at(0.625f), vec4(0, 1, 0.5f, 0.35f)));
}

TEST_CASE("flip-books: which frames show", "[particle]") {
    CHECK(framesOnce(0, 4, true) == vec3(0, 1, 0));
    CHECK(framesOnce(0.5f, 4, true) == vec3(1, 2, 0.5f));
    CHECK(framesOnce(1, 4, true) == vec3(2, 3, 1));
    CHECK(framesOnce(0, 4, false) == vec3(0, 0, 0));
    CHECK(framesOnce(0.26f, 4, false) == vec3(1, 1, 0));
    CHECK(framesOnce(0.99f, 4, false).x == 3);
    CHECK(framesOnce(1, 4, false).x == 3);
    CHECK(framesAgain(0, 8, 0, 4, true) == vec3(0, 1, 0));
    CHECK(framesAgain(0.4375f, 8, 0, 4, true) == vec3(3, 0, 0.5f));
    CHECK(framesAgain(0.5f, 8, 0, 4, true) == vec3(0, 1, 0));
    CHECK(framesAgain(0, 8, 0.5f, 4, true) == vec3(2, 3, 0));
    CHECK(framesAgain(0.4375f, 8, 0, 4, false) == vec3(3, 0, 0));
    for (const float seconds : {0.0f, 1e-30f, 3.1f, 1e6f, 1e30f}) {
        const vec3 frames = framesAgain(seconds, 1000, 0.999999f, 4096, true);
        CHECK((frames.x >= 0 && frames.x <= 4095 && frames.y >= 0 && frames.y <= 4095));
        CHECK((frames.z >= 0 && frames.z <= 1));
    }
}

TEST_CASE("rotations: quaternions as GLM has them", "[particle]") {
    const vec3 axis = normalize(vec3(1, -2, 0.5f)), v(0.3f, 0.7f, -1.1f);
    const vec4 a = aboutAxis(axis, 0.8f), b = aboutAxis(vec3(0, 0, 1), -2.0f);
    CHECK(length(turned(a, v) - quatOf(a) * v) < 1e-6f);
    CHECK(length(turned(a, v) - glm::angleAxis(0.8f, axis) * v) < 1e-6f);
    CHECK(length(turned(composed(a, b), v) - turned(a, turned(b, v))) < 1e-6f);
}

TEST_CASE("rotations and axes of particles: unit, and every way alike", "[particle]") {
    constexpr int count = 20000;
    glm::dvec3 axes(0), fronts(0), squares(0);
    for (uint seed = 0; seed < count; ++seed) {
        const vec4 q = randomRotation(seed);
        const vec3 axis = randomAxis(seed), front = turned(q, vec3(0, 0, 1));
        REQUIRE(std::abs(length(q) - 1) < 1e-5f);
        REQUIRE(std::abs(length(axis) - 1) < 1e-5f);
        axes += glm::dvec3(axis);
        fronts += glm::dvec3(front);
        squares += glm::dvec3(front * front);
    }
    // Each component has a mean of 0 and a mean square of 1/3. Five standard deviations: one seed family in
    // 300,000 fails.
    const double five = 5 / std::sqrt(3.0 * count);
    for (int i = 0; i < 3; ++i) {
        CHECK(std::abs(axes[i] / count) < five);
        CHECK(std::abs(fronts[i] / count) < five);
        CHECK(std::abs(squares[i] / count - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / count));
    }
}

TEST_CASE("ages: shares of a life", "[particle]") {
    CHECK(ageShare(vec2(0, 2)) == 0);
    CHECK(ageShare(vec2(0.5f, 2)) == 0.25f);
    CHECK(ageShare(vec2(3, 2)) == 1);
    CHECK(ageShare(vec2(100, 1e30f)) < 1e-20f);
    CHECK(ageShare(vec2(0, 0)) == 0);
}

TEST_CASE("what turns for ever turns on evenly after a day", "[particle]") {
    const double turn = 2 * std::acos(-1.0);
    const auto at = [](float rate, double time) {
        const double blocks = std::floor(time / 64);
        return double(turnedBy(rate, uint32_t(blocks), float(time - 64 * blocks)));
    };
    for (const float rate : {0.3f, 5.0f, -7.3f})
        for (int frame = -3; frame < 3; ++frame) {  // 1600 blocks are 102,400 s
            const double time = 1600 * 64 + frame / 60.0;
            const double turned = at(rate, time + 1 / 60.0) - at(rate, time);
            CHECK(std::abs(std::remainder(turned - double(rate) / 60, turn)) < 1e-4);
        }
}
