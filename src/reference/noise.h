// The lattice noises of the vector fields in double precision, written from their definition: shaders share
// the lattice (the hash, its seeds, a byte's meaning) and nothing else with this file.
//
// A lattice point's hash is pcg4d(x, y, z, w) in 32-bit integers [Jarzynski 2020]; the
// four bytes b of one word, lowest first, are the gradient's components b / 127.5 - 1. The noise at p is the
// sum over the corners of p's cell of (gradient . (p - corner)), weighted by Perlin's quintic in every
// dimension [Perlin 2002]: twice continuously differentiable, 0 at lattice points.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace shoal::reference {

std::array<uint32_t, 4> pcg4d(std::array<uint32_t, 4> v);

// Three dimensions; the hash is that of (x, y, z, seed), of which the first word counts.
double gradientNoise(const glm::dvec3& p, uint32_t seed);

// A vector potential of three noises in (x, y, z, t): component k uses word k of the hash of
// (x, y, z, t + 0x9e3779b9 seed).
struct Potential {
    glm::dvec3 value{0};
    glm::dmat3 slope{0};  // slope[j][k] = d value[k] / d p[j]
};
Potential vectorPotential(const glm::dvec3& p, double t, uint32_t seed);

// The potential's curl over p, free of divergence [Bridson 2007].
glm::dvec3 curlNoise(const glm::dvec3& p, double t, uint32_t seed);

// Noise by table (scene/noise_tile.h). The reference reads the same values as the shaders, each kind's tile
// in double precision, joined linearly along each axis.
//
// A gust's n at p, in lengths along and widths across. The tile's pattern is moved across by `gustShift` for
// each tile along.
double gustFromTile(const glm::dvec3& p, uint32_t seed);
// The velocity at p, in lengths, at t, in periods, where `speed` is 1. Moment k, at t = k, sees the tile from
// tilePlace(k) on, and drifts. Between two moments their velocities have the parts 1 - w and w of Perlin's
// quintic, divided by the root of the sum of their squares.
glm::dvec3 curlFromTile(const glm::dvec3& p, double t, int octaves, uint32_t seed);

}  // namespace shoal::reference
