#include "reference/noise.h"

#include <cmath>

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

}  // namespace shoal::reference
