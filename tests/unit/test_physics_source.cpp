// The shaders' physics, compiled as C++, against the double reference. Both are written from the same
// definitions; what may differ is float rounding: 6e-8 of the largest number in a formula, times its length.
#include <cmath>
#include <numbers>

#include "molecule/skin.h"
#include "reference/discrete.h"
#include "reference/fields.h"
#include "reference/noise.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/shader_physics.h"
#include "support/shapes.h"

namespace shoal {

using glm::dvec3;
using glm::vec3;

namespace {

// Points within 8 m, that float holds exactly so that both sides see the same one.
vec3 sample(int i) {
    const vec3 p(float(std::fmod(i * 7.31, 16.0)) - 8, float(std::fmod(i * 3.77, 16.0)) - 8,
                 float(std::fmod(i * 5.23, 16.0)) - 8);
    return glm::floor(p * 1024.0f) / 1024.0f + 1.0f / 4096;
}

float timeOf(int i) {
    return float(i % 37) * 0.125f + 0.0625f;
}

// The largest difference over many points and times between a shader field and its reference.
template <typename Shader>
double worst(const FieldShape& shape, Shader&& shader) {
    double most = 0;
    for (int i = 0; i < 2000; ++i) {
        const vec3 x = sample(i);
        const dvec3 expected = reference::fieldVelocity(shape, dvec3(x), double(timeOf(i)));
        most = std::max(most, glm::length(dvec3(shader(x, timeOf(i))) - expected));
    }
    return most;
}

}  // namespace

TEST_CASE("the shader's hash is the reference's", "[physics]") {
    for (uint32_t i = 0; i < 1000; ++i) {
        const glm::uvec4 v = shader::pcg4d(glm::uvec4(i, 7 * i, ~i, 0x80000000u + i));
        const auto w = reference::pcg4d({i, 7 * i, ~i, 0x80000000u + i});
        REQUIRE(v == glm::uvec4(w[0], w[1], w[2], w[3]));
    }
}

TEST_CASE("shader noise agrees with the reference on both sides of 0", "[physics]") {
    for (int i = 0; i < 2000; ++i) {
        const vec3 p = sample(i);
        // weights add up to 1 and ramps are below 3: a few rounding steps
        REQUIRE(std::abs(shader::gradientNoise(p, glm::uvec3(0u), 11u) -
                         reference::gradientNoise(dvec3(p), 11)) < 1e-6);
        const vec3 curl = shader::curlNoise(p, timeOf(i) - 2, 0u, 5u, glm::uvec3(0u));
        REQUIRE(glm::length(dvec3(curl) - reference::curlNoise(dvec3(p), double(timeOf(i)) - 2, 5)) < 1e-5);
    }
}

TEST_CASE("simplex noise has the slope of its values, and is as strong and as steep as gradient noise",
          "[physics]") {
    constexpr float step = 1.0f / 256;
    constexpr int count = 20000;
    double value = 0, steepness = 0, expectedValue = 0, expectedSteepness = 0;
    for (int i = 0; i < count; ++i) {
        const vec3 p = sample(i) + vec3(0.37f, 0.61f, 0.13f) * float(i / 512);
        const glm::vec4 noise = shader::simplexNoiseSlope(p, 11u);
        value += noise.w * noise.w / count;
        steepness += glm::dot(vec3(noise), vec3(noise)) / count;
        expectedValue += std::pow(shader::gradientNoise(p, glm::uvec3(0u), 11u), 2) / count;
        for (int axis = 0; axis < 3; ++axis) {
            vec3 ahead(p), behind(p);
            ahead[axis] += step, behind[axis] -= step;
            const auto rise = [&](const auto& at) { return double(at(ahead) - at(behind)) / (2 * step); };
            const double slope = rise([](vec3 x) { return shader::simplexNoiseSlope(x, 11u).w; });
            REQUIRE(std::abs(double(noise[axis]) - slope) < 2e-3);
            expectedSteepness +=
                std::pow(rise([](vec3 x) { return shader::gradientNoise(x, glm::uvec3(0u), 11u); }), 2) /
                count;
        }
    }
    CHECK(std::sqrt(value / expectedValue) == Approx(1).margin(0.05));
    CHECK(std::sqrt(steepness / expectedSteepness) == Approx(1).margin(0.05));
}

TEST_CASE("shader fields agree with the reference", "[physics]") {
    ShearField shear = test::shear();
    const glm::mat3 rows = glm::transpose(glm::mat3(shear.gradient));
    CHECK(worst(shear, [&](vec3 x, float) {
              return shader::shearVelocity(x, vec3(shear.velocity), rows[0], rows[1], rows[2]);
          }) < 3e-6);  // numbers up to 8

    // 3 m/s of a sine whose argument, up to 44, has lost 4e-6
    const OscillatingField oscillating{{1, -2, 2}, 1.5, 0.5};
    CHECK(worst(oscillating, [&](vec3, float time) {
              return shader::oscillatingVelocity(time, {1, -2, 2}, 3 * std::numbers::pi_v<float>, 0.5f);
          }) < 1.5e-5);

    VortexField vortex;
    vortex.axis = glm::normalize(dvec3(1, 2, 0.5));
    vortex.lift = 0.7;
    CHECK(worst(vortex, [&](vec3 x, float) {
              return shader::vortexVelocity(x, vec3(vortex.axis), 3, 1, 0.7f);
          }) < 3e-6);

    // sines of arguments up to 8: the argument's rounding, 5e-7, times the amplitudes
    CHECK(worst(AbcField{.a = 1, .b = 0.75, .c = 0.5},
                [&](vec3 x, float) { return shader::abcVelocity(x, 1, 0.75f, 0.5f, 1); }) < 2e-6);
    CHECK(worst(TaylorGreenField{.speed = 2},
                [&](vec3 x, float) { return shader::taylorGreenVelocity(x, 2, 1); }) < 4e-6);

    GustField gust;
    gust.direction = glm::normalize(dvec3(2, 0.3, -1));
    gust.seed = 3;
    gust.noise = NoiseForm::computed;
    const vec3 along(gust.direction), across(reference::gustAcross(gust.direction));
    // 5 m/s of noise whose argument, up to 20 at the second octave, has lost 2e-6
    CHECK(worst(gust, [&](vec3 x, float time) {
              return shader::gustVelocity(x, time, along, across, 5, 0.6f, 5, {8, 6}, 0, 0u, 3u,
                                          glm::uvec3(0u));
          }) < 3e-5);

    CurlNoiseField curl{
        .speed = 1, .length = 2, .period = 2, .octaves = 4, .seed = 77, .noise = NoiseForm::computed};
    CHECK(worst(curl, [&](vec3 x, float time) {
              return shader::curlNoiseVelocity(x, time, 1, 2, 2, 4, 0, 0u, 77u, glm::uvec3(0u));
          }) < 3e-5);
}

TEST_CASE("shader waves agree with the reference, in deep water and shallow", "[physics][waves]") {
    for (const double depth : {0.0, 40.0, 2.0, 0.3}) {
        WavesField waves;
        if (depth > 0) waves.depth = depth;
        waves.origin = {0.5, 4, -0.25};
        waves.trains = {{{1, 0, 2}, 0.2, 6, 0.5}};
        const WaveTrain& train = waves.trains[0];
        const double k = 2 * std::numbers::pi / train.wavelength, h = waves.depth.value_or(1e9);
        const double omega = std::sqrt(9.81 * k * std::tanh(k * h));
        const double speed = train.amplitude * omega / -std::expm1(-2 * k * h);
        const glm::vec2 along = glm::normalize(glm::vec2(1, 2));
        // up to 1 m/s (3 m/s where it is shallow) with an argument, up to 35, that has lost 4e-6
        CHECK(worst(waves, [&](vec3 x, float time) {
                  return shader::waveVelocity(x - vec3(waves.origin), time, along, float(k), float(omega),
                                              0.5f, float(speed), float(h), 0.2f);
              }) < 2e-5);
    }
}

TEST_CASE("the shader's hurricane agrees with the reference", "[physics][hurricane]") {
    for (const double coriolis : {0.0, 0.5}) {
        const HurricaneField storm{{0, -4, 0}, 12, 3, 1.6, 0.4, 10, coriolis};
        // 12 m/s through a power, an exponential and a root
        CHECK(worst(storm, [&](vec3 x, float) {
                  return shader::hurricaneVelocity(x - vec3(0, -4, 0), 12, 3, 1.6f, std::tan(0.4f), 10,
                                                   float(coriolis));
              }) < 5e-5);
    }
    // nowhere a division by 0
    for (const vec3 x : {vec3(0), vec3(0, 5, 0), vec3(1e-9f, 5, 0), vec3(1e15f, 5, 1e15f), vec3(0, 1e15f, 0)})
        for (const float speed : {0.0f, 1e-9f, 1e3f})
            for (const float radius : {1e-9f, 1.0f, 1e9f})
                CHECK(glm::all(glm::lessThan(
                    glm::abs(shader::hurricaneVelocity(x, speed, radius, 3, 0.4f, 10, 0)), vec3(1e14f))));
}

TEST_CASE("shader springs agree with the reference", "[physics]") {
    const Molecule molecule = test::pair(1, 1, 300, 2);
    const reference::Problem problem{.molecule = &molecule};
    for (int i = 0; i < 500; ++i) {
        const vec3 a = sample(i) * 0.1f, b = sample(i + 1) * 0.1f, v = sample(i + 2);
        const auto expected = reference::springAcceleration(problem, {dvec3(a), dvec3(b)}, {dvec3(v), {}}, 0);
        const vec3 force = shader::springForce(a - b, v, 300, 2, 1);
        REQUIRE(glm::length(dvec3(force) - expected[0]) < 1e-6 * (300 + glm::length(expected[0])));
    }
    CHECK(shader::springForce(vec3(0), vec3(1), 300, 2, 1) == vec3(0));
    CHECK(shader::springForce(vec3(1e-13f, 0, 0), vec3(0), 300, 2, 1).x == Approx(30));  // of 300
    CHECK(shader::springForce(vec3(1, 0, 0), vec3(0), 300, 2, 1) == vec3(0));
    const float pull =
        shader::musclePull({0.25f, 3, 0.5f}, 0.25f, 0.5f, std::numbers::pi_v<float> / 2 - 2.25f);
    CHECK(pull == Approx(0.25));
    CHECK(shader::bentLength(2, pull, -0.5f) == Approx(1.5));
}

TEST_CASE("shader drag agrees with the reference's step", "[physics]") {
    const Molecule molecule = test::leaf(0, 0);
    const dvec3 gravity{1, -9.81, 2}, wind{3, -1, 2};
    for (double rate : {0.0, 1e-3, 0.7, 20.0, 1e5}) {
        for (double ratio : {1.0, 6.0}) {
            reference::Problem problem{
                .molecule = &molecule, .gravity = gravity, .drag = {rate * ratio, rate}};
            problem.fields.push_back(test::field(UniformField{wind}));
            const reference::State start =
                reference::restState(problem, {.rotation = test::turned()}, {0.5, 2, -1}, {1, 0, 1});
            const reference::Vectors n = vertexNormals(*problem.molecule, start.position);
            reference::State next = start;
            const double h = 0.01;
            reference::eulerStep(problem, next, h);
            auto decay = [&](double r) { return float(-std::expm1(-r * h)); };
            auto phi = [&](double r) { return float(r == 0 ? h : -std::expm1(-r * h) / r); };
            const double rn = problem.drag.normal, rt = problem.drag.tangent;
            for (size_t i = 0; i < 4; ++i) {
                const vec3 v(start.velocity[i]), u(wind), g(gravity), normal(n[i]);
                const vec3 split = shader::directionalDragAndGravity(v, u, g, normal, {decay(rn), decay(rt)},
                                                                     {phi(rn), phi(rt)});
                CHECK(glm::length(dvec3(split) - next.velocity[i]) < 2e-6);
                if (ratio == 1) {
                    const vec3 plain = shader::dragAndGravity(v, u, g, decay(rt), phi(rt));
                    CHECK(glm::length(dvec3(plain) - next.velocity[i]) < 2e-6);
                    CHECK(glm::length(split - plain) < 1e-6f);
                }
            }
        }
    }
    // no surface: the rate along
    const vec3 none =
        shader::directionalDragAndGravity(vec3(1), vec3(0), vec3(0), vec3(0), {1, 0.5f}, {0, 0});
    CHECK(none == vec3(0.5f));
}

TEST_CASE("shader normals: unit, and up where the sum vanishes", "[physics]") {
    CHECK(shader::areaVector({2, 0, 0}, {0, 3, 0}) == vec3(0, 0, 6));
    for (float size : {1e-6f, 1e-3f, 1.0f, 1e6f}) {
        CHECK(glm::length(shader::unitNormal(vec3(1, 2, 3) * size)) == Approx(1));
    }
    CHECK(shader::unitNormal(vec3(0)) == vec3(0, 1, 0));
}

TEST_CASE("an anchor moves by lattice steps, exactly", "[physics]") {
    CHECK(shader::anchorShift({1, -1, 0.3f}) == vec3(0));
    for (int i = 0; i < 500; ++i) {
        const vec3 p = sample(i) * 1.37f;
        const vec3 shift = shader::anchorShift(p);
        CHECK(glm::floor(shift * 16.0f) == shift * 16.0f);
        const bool moves = glm::any(glm::greaterThan(glm::abs(p), vec3(1)));
        CHECK((shift != vec3(0)) == moves);
        if (!moves) continue;
        CHECK(glm::all(glm::lessThanEqual(glm::abs(p - shift), vec3(1 / 32.0f))));
        CHECK(dvec3(p - shift) == dvec3(p) - dvec3(shift));
    }
}

TEST_CASE("random numbers are uniform and hang on both seed and counter", "[physics]") {
    double sum = 0, square = 0;
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
        const double r = shader::uniformFrom(shader::hashSeed(uint32_t(i % 317), uint32_t(i / 317)));
        REQUIRE(r >= 0);
        REQUIRE(r < 1);
        sum += r, square += r * r;
    }
    // standard errors: 0.0009 and 0.0009
    CHECK(sum / count == Approx(0.5).margin(0.004));
    CHECK(square / count == Approx(1 / 3.0).margin(0.004));
    CHECK(shader::hashSeed(1, 2) != shader::hashSeed(2, 1));
}

TEST_CASE("pins are released by a pull above the limit, or by chance", "[physics]") {
    CHECK(shader::isReleased(2, 1, 7, 3, 0));
    CHECK_FALSE(shader::isReleased(1, 1, 7, 3, 0));
    CHECK(shader::isReleased(0, 1, 7, 3, 1));
    int released = 0;
    for (uint32_t seed = 0; seed < 10000; ++seed)
        released += shader::isReleased(0, 1, seed, 3, 0.25f);
    CHECK(released == Approx(2500).margin(130));  // three standard errors
}

TEST_CASE("contact leaves a velocity without the kick that is owed, and as it was where nothing touches",
          "[physics]") {
    const vec3 v(0.1f, -3, 0.7f), kick(1e-3f, 0.3f, 7);
    CHECK(shader::withoutKick(v + kick, v, kick) == v);
    CHECK(shader::withoutKick(vec3(0), v, kick) == -kick);
}

TEST_CASE("leapfrog drifts by half of the old and half of the new velocity, where it slips by the new one",
          "[physics]") {
    const vec3 v(1, -2, 3), dragged(3, 2, -1);
    shader::substep = 0.25f, shader::slips = 0;
    CHECK(shader::driftOf(v, dragged) == vec3(0.5f, 0, 0.25f));
    shader::slips = 1;
    CHECK(shader::driftOf(v, dragged) == vec3(0.75f, 0.5f, -0.25f));
}

TEST_CASE("the coefficients of drag agree with double precision at every rate, and where there is none",
          "[physics]") {
    for (const double rate : {1e-9, 1e-4, 0.03, 0.4, 0.7, 1.5, 30.0, 1e4, -0.2, -1.2})
        for (const double h : {1e-3, 0.25, 1.0}) {
            const double decay = -std::expm1(-rate * h), phi = decay / rate;
            CAPTURE(rate, h);
            CHECK(shader::dragDecay(float(rate * h)) == Approx(decay).epsilon(5e-7));
            CHECK(shader::dragPhi(float(rate), float(h)) == Approx(phi).epsilon(1e-6));
            // (h - phi) / rate by integration, without its difference: the integral of (h - t) exp(-rate t)
            double bend = 0;
            const int n = 20000;
            for (int i = 0; i < n; ++i) {
                const double t = (i + 0.5) * h / n;
                bend += (h - t) * std::exp(-rate * t) * h / n;
            }
            if (rate * h < 100) CHECK(shader::dragBend(float(rate), float(h)) == Approx(bend).epsilon(5e-6));
        }
    CHECK(shader::dragPhi(0, 0.25f) == 0.25f);
    CHECK(shader::dragBend(0, 0.25f) == 0.03125f);
}

TEST_CASE("bilinear heights", "[physics]") {
    CHECK(shader::bilinear(1, 2, 3, 4, {0, 0}) == 1);
    CHECK(shader::bilinear(1, 2, 3, 4, {1, 0}) == 2);
    CHECK(shader::bilinear(1, 2, 3, 4, {0, 1}) == 3);
    CHECK(shader::bilinear(1, 2, 3, 4, {0.5f, 0.5f}) == 2.5f);
}

}  // namespace shoal
