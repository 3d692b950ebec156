// The reference's vector fields against closed forms and invariants.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "reference/fields.h"
#include "reference/noise.h"
#include "scene/field_kinds.h"
#include "support/catch.h"
#include "support/every_kind.h"

namespace shoal::reference {

using std::numbers::pi;

static void same(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
    INFO(a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z);
    CHECK(glm::length(a - b) <= tolerance);
}

// Points that no lattice or period singles out.
static glm::dvec3 sample(int i) {
    return {std::fmod(i * 7.31 + 0.17, 19.0) - 9.5, std::fmod(i * 3.77 + 0.31, 17.0) - 8.5,
            std::fmod(i * 5.23 + 0.53, 23.0) - 11.5};
}

TEST_CASE("closed-form fields", "[reference][field]") {
    same(fieldVelocity(UniformField{{1, 2, 3}}, {9, 9, 9}, 4), {1, 2, 3});

    const OscillatingField oscillating{{1, 2, -4}, 0.5, pi / 6};  // a turn in 2 s
    same(fieldVelocity(oscillating, {9, 9, 9}, 0), {0.5, 1, -2});
    same(fieldVelocity(oscillating, {9, 9, 9}, 1 / 3.0), {1, 2, -4});
    same(fieldVelocity(oscillating, {-9, 0, 9}, 1 / 3.0 + 7), {-1, -2, 4});
    same(fieldVelocity(OscillatingField{{1, 2, 3}, 0, 0}, {9, 9, 9}, 5), {0, 0, 0});

    ShearField shear;
    shear.origin = {1, 1, 1};
    shear.velocity = {2, 0, 0};
    shear.gradient = glm::transpose(glm::dmat3(0, 1, 2, 3, 4, 5, 6, 7, 8));  // rows 012, 345, 678
    same(fieldVelocity(shear, {2, 3, 4}, 0), {2 + 0 + 2 + 6, 3 + 8 + 15, 6 + 14 + 24});

    VortexField vortex;
    vortex.origin = {1, 0, 0};
    vortex.axis = {0, 2, 0};
    vortex.speed = 3;
    vortex.radius = 0.5;
    vortex.lift = 4;
    same(fieldVelocity(vortex, {1.5, 7, 0}, 0), {0, 2, -3});  // at the radius: full speed, half the lift
    same(fieldVelocity(vortex, {1, -2, 0}, 0), {0, 4, 0});
    same(fieldVelocity(vortex, {1, 0, 1}, 0), {3 * 4.0 / 5, 4 / 5.0, 0});

    AbcField abc;
    abc.a = 1, abc.b = 2, abc.c = 3, abc.wavelength = 4;
    abc.origin = {0, 0, 1};
    same(fieldVelocity(abc, {1, 0, 1}, 0), {3, 2 + 1, 2 * 0.0 + 0});
    same(fieldVelocity(abc, {0, 1, 2}, 0), {1 + 0, 0, 3 + 2});

    TaylorGreenField green;
    green.speed = 2, green.wavelength = 8;
    same(fieldVelocity(green, {0, 2, 0}, 0), {2, 0, 0});
    same(fieldVelocity(green, {1, 1, 1}, 0), {1 / std::sqrt(2.0), -1 / std::sqrt(2.0), 0});
}

TEST_CASE("every kind of field is there, and as its closed form says", "[reference][field]") {
    std::vector<bool> there(std::variant_size_v<FieldShape::variant>);
    for (const test::KindOfField& kind : test::kindsOfField()) {
        there[kind.shape.index()] = true;
        INFO(kindName(kind.shape));
        if (!kind.known) continue;
        const auto& [x, value] = *kind.known;
        same(fieldVelocity(kind.shape, x, 0), value);
        if (std::holds_alternative<ShearField>(kind.shape)) continue;  // its gradient has no writer
        same(fieldVelocity(*test::readBack(test::field(kind.shape)).shape, x, 0), value);
    }
    CHECK(std::find(there.begin(), there.end(), false) == there.end());
}

TEST_CASE("fields add up with weight and box", "[reference][field]") {
    std::vector<Field> fields(2);
    fields[0].shape = UniformField{{1, 0, 0}};
    fields[0].weight = 3;
    fields[1].shape = UniformField{{0, 1, 0}};
    fields[1].box = Box{{0, 0, 0}, {1, 2, 3}};
    same(fluidVelocity(fields, {0.5, 1.9, 2.9}, 0), {3, 1, 0});
    same(fluidVelocity(fields, {0.5, 2.1, 2.9}, 0), {3, 0, 0});
    same(fluidVelocity(fields, {-0.1, 1, 1}, 0), {3, 0, 0});
    same(fluidVelocity({}, {1, 1, 1}, 0), {0, 0, 0});
}

TEST_CASE("a grid is trilinear between cell centres and clamps or wraps", "[reference][field]") {
    GridField grid;
    grid.resolution = {3, 2, 4};
    grid.low = {-1, 0, 2};
    grid.high = {2, 1, 4};  // cells of 1 x 0.5 x 0.5 m
    auto linear = [](const glm::dvec3& x) { return glm::dvec3(2 * x.x, x.y - x.z, 3 + x.z); };
    for (int z = 0; z < 4; ++z) {
        for (int y = 0; y < 2; ++y) {
            for (int x = 0; x < 3; ++x) {
                const glm::dvec3 center{-0.5 + x, 0.25 + 0.5 * y, 2.25 + 0.5 * z};
                grid.values.push_back(glm::vec3(linear(center)));
            }
        }
    }
    const glm::dvec3 inside{0.8, 0.6, 3.1};
    same(fieldVelocity(grid, inside, 0), linear(inside), 1e-6);  // values are floats
    same(fieldVelocity(grid, {-0.9, 0.01, 2.1}, 0), linear({-0.5, 0.25, 2.25}), 1e-6);
    same(fieldVelocity(grid, {50, -50, 50}, 0), linear({1.5, 0.25, 3.75}), 1e-6);
    grid.wrap = true;
    same(fieldVelocity(grid, inside + glm::dvec3(3, -2, 8), 0), linear(inside), 1e-6);
    // between the last and the first cell
    const glm::dvec3 seam = 0.5 * (linear({1.5, 0.25, 2.25}) + linear({-0.5, 0.25, 2.25}));
    same(fieldVelocity(grid, {-1, 0.25, 2.25}, 0), seam, 1e-6);
    same(fieldVelocity(grid, {2, 0.25, 2.25}, 0), seam, 1e-6);
}

TEST_CASE("a sequence of grids is linear in time, holds its ends or repeats", "[reference][field]") {
    GridField grid;
    grid.resolution = {1, 1, 1};
    grid.low = {0, 0, 0}, grid.high = {1, 1, 1};
    grid.values = {{1, 0, 0}, {3, 2, 0}, {0, 0, 6}};
    grid.times = {1, 2, 4};
    const glm::dvec3 x(0.3);
    same(fieldVelocity(grid, x, -5), {1, 0, 0});
    same(fieldVelocity(grid, x, 1.25), {1.5, 0.5, 0});
    same(fieldVelocity(grid, x, 2), {3, 2, 0});
    same(fieldVelocity(grid, x, 3), {1.5, 1, 3});
    same(fieldVelocity(grid, x, 70), {0, 0, 6});
    grid.repeats = true;  // from 4 s to 6 s back to the first
    same(fieldVelocity(grid, x, 5), {0.5, 0, 3});
    same(fieldVelocity(grid, x, 1.25 + 5 * 7), {1.5, 0.5, 0});
    same(fieldVelocity(grid, x, 0.5), {0.75, 0, 1.5});
}

TEST_CASE("gradient noise vanishes on the lattice and has mean 0", "[reference][field]") {
    CHECK(gradientNoise({3, -4, 5}, 1) == 0);
    double sum = 0, square = 0, most = 0;
    const int count = 200000;
    for (int i = 0; i < count; ++i) {
        const double n = gradientNoise(sample(i) * 11.0, 7);
        sum += n, square += n * n, most = std::max(most, std::abs(n));
    }
    CHECK(std::abs(sum / count) < 0.01);
    CHECK(std::sqrt(square / count) > 0.1);
    CHECK(most < 1.5);
    CHECK(gradientNoise(sample(1), 7) != gradientNoise(sample(1), 8));
}

TEST_CASE("a gust keeps its direction, its mean and travels with its fronts", "[reference][field]") {
    GustField gust;
    gust.direction = {3, 0.4, -1};
    gust.seed = 5;
    gust.noise = GENERATE(NoiseForm::computed, NoiseForm::table);
    const glm::dvec3 along = glm::normalize(gust.direction);
    glm::dvec3 sum(0);
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 u = fieldVelocity(gust, sample(i) * 20.0, 0.01 * i);
        REQUIRE(glm::length(glm::cross(u, along)) < 1e-9);
        sum += u / double(count);
    }
    same(sum, gust.speed * along, 0.05 * gust.speed);
    const glm::dvec3 x = sample(3);
    same(fieldVelocity(gust, x, 1), fieldVelocity(gust, x + along * gust.frontSpeed * 2.0, 3), 1e-9);
    CHECK(glm::length(fieldVelocity(gust, x, 1) - fieldVelocity(gust, x, 2)) > 1e-3);
}

TEST_CASE("curl noise is free of divergence, unbiased and about as fast as it says", "[reference][field]") {
    for (int octaves : {1, 3}) {
        CurlNoiseField noise;
        noise.speed = 2;
        noise.length = 1.5;
        noise.octaves = octaves;
        noise.seed = 9;
        noise.noise = NoiseForm::computed;
        glm::dvec3 sum(0);
        double square = 0;
        const int count = 60000;
        for (int i = 0; i < count; ++i) {
            const glm::dvec3 u = fieldVelocity(noise, sample(i) * 5.0, 0.013 * i);
            sum += u / double(count);
            square += glm::dot(u, u) / count;
        }
        CHECK(glm::length(sum) < 0.02 * noise.speed);
        INFO("rms " << std::sqrt(square));
        CHECK(std::sqrt(square) > 0.5 * noise.speed);
        CHECK(std::sqrt(square) < 2 * noise.speed);
        // central differences: an error of h^2 u''' / 6, about 1e-6 here, and rounding of 1e-16 / h
        const double h = 1e-5;
        for (int i = 0; i < 200; ++i) {
            double divergence = 0, steepest = 0;
            for (int d = 0; d < 3; ++d) {
                glm::dvec3 e(0);
                e[d] = h;
                const glm::dvec3 slope = (fieldVelocity(noise, sample(i) + e, 0.3 * i) -
                                          fieldVelocity(noise, sample(i) - e, 0.3 * i)) /
                                         (2 * h);
                divergence += slope[d];
                steepest = std::max(steepest, glm::length(slope));
            }
            CHECK(std::abs(divergence) < 1e-6 * std::max(steepest, 1.0));
        }
    }
}

TEST_CASE("the curl is the potential's", "[reference][field]") {
    const double h = 1e-5;
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 p = sample(i);
        const glm::dmat3 slope = vectorPotential(p, 0.1 * i, 3).slope;
        for (int d = 0; d < 3; ++d) {
            glm::dvec3 e(0);
            e[d] = h;
            const glm::dvec3 difference =
                (vectorPotential(p + e, 0.1 * i, 3).value - vectorPotential(p - e, 0.1 * i, 3).value) /
                (2 * h);
            same(difference, slope[d], 1e-7);
        }
    }
}

}  // namespace shoal::reference
