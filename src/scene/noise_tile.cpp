#include "scene/noise_tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include <glm/gtc/packing.hpp>

#include "core/contract.h"
#include "core/parallel.h"

namespace shoal {

namespace {

constexpr int kinds = 5;

// Values at points of a periodic grid, x fastest.
template <typename T>
struct Periodic {
    glm::ivec3 size;
    std::vector<T> values;

    explicit Periodic(const glm::ivec3& points)
        : size(points), values(size_t(points.x) * size_t(points.y) * size_t(points.z)) {}
    size_t index(glm::ivec3 texel) const {
        for (int d = 0; d < 3; ++d)
            texel[d] = (texel[d] % size[d] + size[d]) % size[d];
        return (size_t(texel.z) * size_t(size.y) + size_t(texel.y)) * size_t(size.x) + size_t(texel.x);
    }
    // Sets each value to work(point), on all threads.
    template <typename Work>
    void fill(const Work& work) {
        parallel(size.z, allThreads(), [&](int z) {
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    values[index({x, y, z})] = work(glm::ivec3(x, y, z));
        });
    }
};

glm::ivec3 corner(int i) {
    return {i & 1, (i >> 1) & 1, i >> 2};
}

glm::uvec4 pcg4d(glm::uvec4 v) {  // [Jarzynski 2020]
    const auto mix = [&v] {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
    };
    v = v * 1664525u + 1013904223u;
    mix();
    v = v ^ (v >> 16u);
    mix();
    return v;
}

// The lattice of one octave: for each of three noises a gradient and a value, of bytes as in
// shaders/physics/noise.glsl.
using Gradients = glm::dmat3x4;

Periodic<Gradients> lattice(const glm::ivec3& cells, uint32_t seed) {
    Periodic<Gradients> out(cells);
    out.fill([&](const glm::ivec3& cell) {
        const glm::uvec4 hash = pcg4d(glm::uvec4(glm::uvec3(cell), seed));
        Gradients g;
        for (int k = 0; k < 3; ++k)
            for (int byte = 0; byte < 4; ++byte)
                g[k][byte] = double((hash[k] >> (8 * byte)) & 255u) / 127.5 - 1;
        return g;
    });
    return out;
}

// A noise in space and time, cut at a time: its lattice has values beside gradients, from the gradients along
// time. This much of them has the covariance in space that noise in four dimensions has on the average over
// time: with w Perlin's quintic, the root of the integral of (1 - w)^2 t^2 over that of w^2.
constexpr double partOfValues = 0.27530;

glm::dvec3 noise(const Periodic<Gradients>& lattice, const glm::dvec3& p, double valuePart) {
    const glm::dvec3 low = glm::floor(p), f = p - low;
    const glm::dvec3 w = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    glm::dvec3 sum(0);
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 side = corner(i);
        const glm::dvec3 weights = glm::mix(1.0 - w, w, glm::dvec3(side));
        const glm::dvec4 ramp(f - glm::dvec3(side), valuePart);
        sum += weights.x * weights.y * weights.z *
               (ramp * lattice.values[lattice.index(glm::ivec3(low) + side)]);
    }
    return sum;
}

// The mean of a . b over all places, where values are joined linearly.
template <typename T>
double meanSquare(const Periodic<T>& grid, double (*product)(const T&, const T&)) {
    Periodic<T> smooth = grid;
    for (int d = 0; d < 3; ++d) {
        const Periodic<T> before = smooth;
        glm::ivec3 step(0);
        step[d] = 1;
        smooth.fill([&](const glm::ivec3& texel) {
            return before.values[before.index(texel)] * (2.0 / 3) +
                   (before.values[before.index(texel - step)] + before.values[before.index(texel + step)]) /
                       6.0;
        });
    }
    double sum = 0;
    for (size_t i = 0; i < grid.values.size(); ++i)
        sum += product(grid.values[i], smooth.values[i]);
    return sum / double(grid.values.size());
}

// The curl of a potential that is known in the middles between the values: differences over the boxes between
// eight middles, in which as much flows in as out.
std::vector<float> curlTile(const NoiseTile& tile) {
    Periodic<glm::dvec3> potential(tile.texels), velocity(tile.texels);
    const double cell = double(tile.cells.x) / tile.texels.x;  // lengths
    double expected = 0;
    for (int octave = 0; octave < tile.octaves; ++octave) {
        const double fine = std::exp2(octave), amplitude = std::exp2(-octave / 3.0);
        const Periodic<Gradients> gradients = lattice(tile.cells << octave, uint32_t(octave));
        expected += amplitude * amplitude;
        Periodic<glm::dvec3> sum(tile.texels);
        sum.fill([&](const glm::ivec3& texel) {
            return potential.values[potential.index(texel)] +
                   amplitude / fine *
                       noise(gradients, (glm::dvec3(texel) + 0.5) * (cell * fine), partOfValues);
        });
        potential = std::move(sum);
    }
    velocity.fill([&](const glm::ivec3& texel) {
        glm::dmat3 slope(0);  // slope[j][k] = d potential[k] / d x[j]
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 side = corner(i);
            const glm::dvec3& value = potential.values[potential.index(texel - 1 + side)];
            for (int d = 0; d < 3; ++d)
                slope[d] += value * (side[d] ? 0.25 : -0.25);
        }
        return glm::dvec3(slope[1][2] - slope[2][1], slope[2][0] - slope[0][2], slope[0][1] - slope[1][0]);
    });
    // The RMS of the curl of three noises in four dimensions, from the integrals of the quintic.
    constexpr double unscaled = 1.17708;
    const double scale =
        unscaled * std::sqrt(expected / meanSquare<glm::dvec3>(velocity, [](const auto& a, const auto& b) {
                                 return glm::dot(a, b);
                             }));
    const double unit = tile.range / 511;
    std::vector<float> out;
    out.reserve(velocity.values.size() * 3);
    for (const glm::dvec3& u : velocity.values)
        for (int d = 0; d < 3; ++d) {
            EXPECTS(std::abs(u[d] * scale) <= tile.range);
            out.push_back(float(std::round(u[d] * scale / unit) * unit));
        }
    return out;
}

std::vector<float> gustTile(const NoiseTile& tile) {
    const Periodic<Gradients> large = lattice(tile.cells, 100), small = lattice(tile.cells * 2, 101);
    Periodic<double> grid(tile.texels);
    grid.fill([&](const glm::ivec3& texel) {
        const glm::dvec3 p = (glm::dvec3(texel) + 0.5) * glm::dvec3(tile.cells) / glm::dvec3(tile.texels);
        return noise(large, p, 0).x + noise(small, 2.0 * p + 0.31, 0).x / 2;
    });
    double mean = 0;
    for (const double n : grid.values)
        mean += n / double(grid.values.size());
    for (double& n : grid.values)
        n -= mean;
    // The standard deviation of the computed noise, from the integrals of the quintic.
    constexpr double deviation = 0.25718;
    const double scale = deviation / std::sqrt(meanSquare<double>(
                                         grid, [](const double& a, const double& b) { return a * b; }));
    std::vector<float> out;
    for (const double n : grid.values)
        out.push_back(glm::unpackHalf1x16(glm::packHalf1x16(float(n * scale))));
    return out;
}

}  // namespace

const char* NoiseTile::sampler() const {
    static constexpr const char* names[kinds] = {"gustTile", "curlTile1", "curlTile2", "curlTile3",
                                                 "curlTile4"};
    return names[octaves];
}

NoiseTile noiseTile(int octaves) {
    EXPECTS(octaves >= 0 && octaves < kinds);
    static const NoiseTile tiles[kinds] = {{0, {128, 64, 64}, {16, 8, 8}},
                                           {1, glm::ivec3(64), glm::ivec3(8), 4},
                                           {2, glm::ivec3(64), glm::ivec3(6), 5},
                                           {3, glm::ivec3(64), glm::ivec3(4), 6},
                                           {4, glm::ivec3(96), glm::ivec3(4), 7}};
    return tiles[octaves];
}

const std::vector<float>& valuesOf(const NoiseTile& tile) {
    static std::array<std::once_flag, kinds> made;
    static std::array<std::vector<float>, kinds> values;
    EXPECTS(tile == noiseTile(tile.octaves));
    const size_t kind = size_t(tile.octaves);
    std::call_once(made[kind], [&] { values[kind] = tile.octaves > 0 ? curlTile(tile) : gustTile(tile); });
    return values[kind];
}

// Multiples of 1/g, 1/g^2, 1/g^3 with g^4 = g + 1: even, and far from one another for numbers that follow.
glm::uvec3 tilePlace(uint32_t number) {
    return number * glm::uvec3(3518319155u, 2882110345u, 2360945575u);
}

double momentDrift(int octaves) {
    return 0.45 + 0.05 * octaves;
}

}  // namespace shoal
