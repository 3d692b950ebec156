#include "reference/noise.h"

#include <algorithm>
#include <cmath>

#include "scene/noise_tile.h"

namespace shoal::reference {

namespace {

double quintic(double t) {
    return ((6 * t - 15) * t + 10) * t * t * t;
}

double quinticSlope(double t) {
    return (t * (t - 2) + 1) * 30 * t * t;
}

double component(uint32_t word, int byte) {
    return double((word >> (8 * byte)) & 0xffu) / 127.5 - 1;
}

// Where p stands in one dimension of the lattice, with both ends' weights and their slopes.
struct Axis {
    uint32_t cell;
    double offset;
    std::array<double, 2> weight, slope;

    explicit Axis(double p) {
        double low = std::floor(p);
        cell = uint32_t(int64_t(low));
        offset = p - low;
        weight = {1 - quintic(offset), quintic(offset)};
        slope = {-quinticSlope(offset), quinticSlope(offset)};
    }
};

}  // namespace

std::array<uint32_t, 4> pcg4d(std::array<uint32_t, 4> v) {
    auto mix = [&v] {
        v[0] += v[1] * v[3];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        v[3] += v[1] * v[2];
    };
    for (uint32_t& word : v)
        word = word * 1664525u + 1013904223u;
    mix();
    for (uint32_t& word : v)
        word ^= word >> 16;
    mix();
    return v;
}

double gradientNoise(const glm::dvec3& p, uint32_t seed) {
    const std::array<Axis, 3> axes{Axis(p.x), Axis(p.y), Axis(p.z)};
    double sum = 0;
    for (uint32_t k = 0; k < 2; ++k) {
        for (uint32_t j = 0; j < 2; ++j) {
            for (uint32_t i = 0; i < 2; ++i) {
                uint32_t word = pcg4d({axes[0].cell + i, axes[1].cell + j, axes[2].cell + k, seed})[0];
                double ramp = component(word, 0) * (axes[0].offset - i) +
                              component(word, 1) * (axes[1].offset - j) +
                              component(word, 2) * (axes[2].offset - k);
                sum += axes[0].weight[i] * axes[1].weight[j] * axes[2].weight[k] * ramp;
            }
        }
    }
    return sum;
}

Potential vectorPotential(const glm::dvec3& p, double t, uint32_t seed) {
    const std::array<Axis, 4> axes{Axis(p.x), Axis(p.y), Axis(p.z), Axis(t)};
    const uint32_t shift = 0x9e3779b9u * seed;
    Potential out;
    for (uint32_t corner = 0; corner < 16; ++corner) {
        std::array<uint32_t, 4> side;
        std::array<uint32_t, 4> key;
        for (uint32_t d = 0; d < 4; ++d) {
            side[d] = (corner >> d) & 1u;
            key[d] = axes[d].cell + side[d];
        }
        key[3] += shift;
        const std::array<uint32_t, 4> hash = pcg4d(key);
        // the product of all weights, and the one where dimension d is replaced by its slope
        auto product = [&](int sloped) {
            double value = 1;
            for (int d = 0; d < 4; ++d) {
                const Axis& axis = axes[size_t(d)];
                value *= (d == sloped ? axis.slope : axis.weight)[side[size_t(d)]];
            }
            return value;
        };
        const double weight = product(-1);
        for (int k = 0; k < 3; ++k) {
            double ramp = 0;
            for (int d = 0; d < 4; ++d) {
                ramp += component(hash[size_t(k)], d) * (axes[size_t(d)].offset - side[size_t(d)]);
            }
            out.value[k] += weight * ramp;
            for (int d = 0; d < 3; ++d) {
                out.slope[d][k] += product(d) * ramp + weight * component(hash[size_t(k)], d);
            }
        }
    }
    return out;
}

glm::dvec3 curlNoise(const glm::dvec3& p, double t, uint32_t seed) {
    const glm::dmat3 d = vectorPotential(p, t, seed).slope;
    return {d[1][2] - d[2][1], d[2][0] - d[0][2], d[0][1] - d[1][0]};
}

namespace {

constexpr double partOfTile = 1.0 / 4294967296.0;

// The tile's values at a place, in tiles.
glm::dvec3 readTile(const NoiseTile& tile, const glm::dvec3& place) {
    const std::vector<float>& values = valuesOf(tile);
    glm::ivec3 low;
    glm::dvec3 share;
    for (int d = 0; d < 3; ++d) {
        const double coordinate = (place[d] - std::floor(place[d])) * tile.texels[d] - 0.5;
        low[d] = int(std::floor(coordinate));
        share[d] = coordinate - low[d];
    }
    glm::dvec3 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        size_t index = 0;
        for (int d = 2; d >= 0; --d) {
            const int upper = (corner >> d) & 1, count = tile.texels[d];
            weight *= upper ? share[d] : 1 - share[d];
            index = index * size_t(count) + size_t((low[d] + upper + count) % count);
        }
        for (int k = 0; k < tile.channels(); ++k)
            sum[k] += weight * double(values[index * size_t(tile.channels()) + size_t(k)]);
    }
    return sum;
}

}  // namespace

double gustFromTile(const glm::dvec3& p, uint32_t seed) {
    const NoiseTile tile = noiseTile(0);
    glm::dvec3 place = p / glm::dvec3(tile.cells);
    place.y += gustShift[0] * partOfTile * place.x;
    place.z += gustShift[1] * partOfTile * place.x;
    return readTile(tile, place + glm::dvec3(tilePlace(0x9e3779b9u * seed)) * partOfTile).x;
}

glm::dvec3 curlFromTile(const glm::dvec3& p, double t, int octaves, uint32_t seed) {
    const NoiseTile tile = noiseTile(octaves);
    const double first = std::floor(t), w = quintic(t - first);
    const auto moment = [&](double k) {
        const uint32_t number = uint32_t(int64_t(k)) + 0x9e3779b9u * seed;
        glm::dvec3 direction(number & 2 ? -1 : 1, number & 1 ? -1 : 1, 0);
        direction.z = direction.x * direction.y;
        const glm::dvec3 drifted = glm::normalize(direction) * (momentDrift(octaves) * (t - k));
        return readTile(tile,
                        (p - drifted) / glm::dvec3(tile.cells) + glm::dvec3(tilePlace(number)) * partOfTile);
    };
    return ((1 - w) * moment(first) + w * moment(first + 1)) / std::hypot(1 - w, w);
}

}  // namespace shoal::reference
