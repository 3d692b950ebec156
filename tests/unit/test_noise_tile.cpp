// Tiles of noise: held against the computed noise by their statistics, and the shader's way to read them
// against the reference.
#include <array>
#include <cmath>
#include <random>

#include "reference/fields.h"
#include "reference/noise.h"
#include "scene/field_kinds.h"
#include "scene/noise_tile.h"
#include "support/catch.h"
#include "support/shader_physics.h"

namespace shoal {

namespace {

// Statistics of a velocity over space and time: mean, RMS, and correlations over a distance and over a time.
struct Statistics {
    glm::dvec3 mean{0};
    double rms = 0, gradient = 0, divergence = 0;  // m/s; RMS of the gradient, 1/s; over the gradient
    std::array<double, 3> apart{}, later{};        // at 1/4, 1/2 and 1 lengths; at 1/4, 1/2 and 3 periods
};

Statistics statisticsOf(const FieldShape& field) {
    constexpr int count = 20000;
    constexpr double h = 1e-4;
    constexpr std::array<double, 3> distances = {0.25, 0.5, 1}, times = {0.25, 0.5, 3};
    std::mt19937 random(4);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto velocity = [&](const glm::dvec3& x, double t) {
        return reference::fieldVelocity(field, x, t);
    };
    Statistics out;
    double square = 0, gradient = 0, divergence = 0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 x(uniform(-50, 50), uniform(-50, 50), uniform(-50, 50));
        const double t = uniform(0, 100);
        const glm::dvec3 u = velocity(x, t);
        out.mean += u / double(count);
        square += glm::dot(u, u);
        double trace = 0;
        for (int d = 0; d < 3; ++d) {
            glm::dvec3 step(0);
            step[d] = h;
            const glm::dvec3 slope = (velocity(x + step, t) - velocity(x - step, t)) / (2 * h);
            gradient += glm::dot(slope, slope);
            trace += slope[d];
        }
        divergence += trace * trace;
        const glm::dvec3 way = glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
        for (size_t k = 0; k < 3; ++k) {
            out.apart[k] += glm::dot(u, velocity(x + way * distances[k], t));
            out.later[k] += glm::dot(u, velocity(x, t + times[k]));
        }
    }
    for (size_t k = 0; k < 3; ++k)
        out.apart[k] /= square, out.later[k] /= square;
    out.rms = std::sqrt(square / count);
    out.gradient = std::sqrt(gradient / count);
    out.divergence = std::sqrt(divergence / gradient);
    return out;
}

CurlNoiseField eddies(int octaves, NoiseForm form) {
    return {.speed = 1, .length = 1, .period = 1, .octaves = octaves, .seed = 3, .noise = form};
}

}  // namespace

TEST_CASE("a tile of curl noise has the speed, the eddies and the changes of computed curl noise",
          "[noise][reference]") {
    for (int octaves = 1; octaves <= 4; ++octaves) {
        const Statistics tile = statisticsOf(eddies(octaves, NoiseForm::table)),
                         computed = statisticsOf(eddies(octaves, NoiseForm::computed));
        INFO(octaves << " octaves: RMS " << tile.rms << " and " << computed.rms << ", gradient "
                     << tile.gradient << " and " << computed.gradient << ", divergence " << tile.divergence
                     << ", apart " << tile.apart[0] << " " << tile.apart[1] << " " << tile.apart[2] << " and "
                     << computed.apart[0] << " " << computed.apart[1] << " " << computed.apart[2]
                     << ", later " << tile.later[0] << " " << tile.later[1] << " " << tile.later[2] << " and "
                     << computed.later[0] << " " << computed.later[1] << " " << computed.later[2]);
        CHECK(glm::length(tile.mean) < 0.03);
        CHECK(std::abs(tile.rms / computed.rms - 1) < 0.02);
        for (size_t k = 0; k < 3; ++k) {
            CHECK(std::abs(tile.apart[k] - computed.apart[k]) < 0.06);
            CHECK(std::abs(tile.later[k] - computed.later[k]) < 0.1);
        }
        CHECK(tile.divergence < (octaves == 1 ? 0.07 : 0.15));
        CHECK(tile.gradient / computed.gradient > 0.8);
        CHECK(tile.gradient / computed.gradient < 1.05);
    }
}

TEST_CASE("a tile of gusts has the mean and the deviation of computed gusts", "[noise][reference]") {
    for (const NoiseForm form : {NoiseForm::table, NoiseForm::computed}) {
        double sum = 0, square = 0;
        std::mt19937 random(4);
        std::uniform_real_distribution<double> place(-400, 400);
        constexpr int count = 100000;
        GustField gust{.speed = 1, .strength = 1, .noise = form};
        for (int i = 0; i < count; ++i) {
            const double n =
                reference::fieldVelocity(gust, {place(random), place(random), place(random)}, 0).x - 1;
            sum += n, square += n * n;
        }
        CHECK(std::abs(sum / count) < 0.005);
        CHECK(std::abs(std::sqrt(square / count) - 0.2572) < 0.004);
    }
}

TEST_CASE("as much flows into each box of a tile as out of it, but for the units of its numbers", "[noise]") {
    for (int octaves = 1; octaves <= 4; ++octaves) {
        const NoiseTile tile = noiseTile(octaves);
        const std::vector<float>& values = valuesOf(tile);
        const double unit = tile.range / 511;
        const auto at = [&](const glm::ivec3& i) {
            const glm::ivec3 w = i % tile.texels;
            const size_t index =
                (size_t(w.z) * size_t(tile.texels.y) + size_t(w.y)) * size_t(tile.texels.x) + size_t(w.x);
            return glm::dvec3(values[3 * index], values[3 * index + 1], values[3 * index + 2]);
        };
        double most = 0;
        for (int z = 0; z < tile.texels.z; z += 5)
            for (int y = 0; y < tile.texels.y; ++y)
                for (int x = 0; x < tile.texels.x; ++x) {
                    double out = 0;
                    for (int i = 0; i < 8; ++i) {
                        const glm::ivec3 side(i & 1, (i >> 1) & 1, i >> 2);
                        const glm::dvec3 u = at(glm::ivec3(x, y, z) + side);
                        for (int d = 0; d < 3; ++d)
                            out += (side[d] ? 0.25 : -0.25) * u[d];
                    }
                    most = std::max(most, std::abs(out));
                }
        // 24 numbers, each off by up to half a unit, a quarter of each
        CHECK(most <= 3.01 * unit);
    }
}

TEST_CASE("seeds read a tile elsewhere", "[noise][reference]") {
    CurlNoiseField one = eddies(1, NoiseForm::table), other = one;
    other.seed = 4;
    GustField gust, gale;
    gale.seed = 1;
    double together = 0, square = 0, gusts = 0, gustsSquare = 0;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-50, 50);
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 x(place(random), place(random), place(random));
        const double t = place(random) + 50;
        const glm::dvec3 u = reference::fieldVelocity(one, x, t);
        together += glm::dot(u, reference::fieldVelocity(other, x, t)), square += glm::dot(u, u);
        const double n = reference::fieldVelocity(gust, x, t).x - 5;
        gusts += n * (reference::fieldVelocity(gale, x, t).x - 5), gustsSquare += n * n;
    }
    CHECK(std::abs(together / square) < 0.15);
    CHECK(std::abs(gusts / gustsSquare) < 0.15);
}

TEST_CASE("curl noise by table does not come back, in space after a tile and in time", "[noise][reference]") {
    const CurlNoiseField field = eddies(1, NoiseForm::table);
    const auto velocity = [&](double x, double t) {
        return reference::fieldVelocity(field, {x, 0.2, 0.4}, t);
    };
    // in space it does: after the 8 lengths that the documents name
    CHECK(glm::length(velocity(0.3, 0.7) - velocity(8.3, 0.7)) < 1e-9);
    CHECK(glm::length(velocity(0.3, 0.7) - velocity(4.3, 0.7)) > 0.01);
    double nearest = 1e9;
    for (int k = 1; k < 2000; ++k) {
        double off = 0;
        for (int i = 0; i < 8; ++i)
            off = std::max(off, glm::length(velocity(0.7 * i, 0.3) - velocity(0.7 * i, 0.3 + k)));
        nearest = std::min(nearest, off);
    }
    CHECK(nearest > 0.1);
}

TEST_CASE("the shader finds its place in a tile where the reference does", "[noise][physics]") {
    for (uint32_t number : {0u, 1u, 77u, 4294967295u})
        CHECK(glm::length(glm::dvec3(shader::tilePlace(number)) -
                          glm::dvec3(tilePlace(number)) / 4294967296.0) < 2e-7);
    // a reading at t is the same whether the frame began then or 2.5 moments before
    const glm::vec3 x(0.3f, -2, 5);
    const shader::MomentPair now = shader::momentsOf(x, 0, 0.1f, 2, 0.05f, 0.25f, 7u, 3u),
                             before = shader::momentsOf(x, 1.25f, 0.1f, 2, 0.05f, 0.75f, 4u, 3u);
    CHECK(glm::length(now.first - before.first) < 1e-5);
    CHECK(glm::length(now.second - before.second) < 1e-5);
    CHECK(std::abs(now.firstPart - before.firstPart) < 1e-6);
    CHECK(std::abs(now.firstPart * now.firstPart + now.secondPart * now.secondPart - 1) < 1e-6);
}

}  // namespace shoal
