// Tiles of noise: what gusts and curl noise read instead of computing it. A tile is a box of values that
// repeats in space and holds all octaves; it depends on nothing but its kind, so that fields share it, and a
// seed only says where in it they read. shaders/physics/field.glsl says how it is read, docs/accuracy.md what
// that is off by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

struct NoiseTile {
    int octaves = 0;       // of curl noise; 0: the tile of gusts
    glm::ivec3 texels{0};  // values along x, y, z, in the middles of as many parts of the tile
    glm::ivec3 cells{0};   // the tile's sides in the field's lengths and widths
    double range = 0;      // of curl noise: the largest component, 511 units

    const char* sampler() const;                          // its name in shaders
    int channels() const { return octaves > 0 ? 3 : 1; }  // of a velocity, or of n
    size_t count() const { return size_t(texels.x) * size_t(texels.y) * size_t(texels.z); }
    size_t bytes() const { return count() * 4; }
    bool operator==(const NoiseTile&) const = default;
};

// The tile of gusts (0), or of curl noise of 1 to 4 octaves.
NoiseTile noiseTile(int octaves);

// The tile's values, x fastest, then y, then z. Made once a process, the same on every machine.
//   curl noise  the velocity where `speed` is 1, in whole units of range / 511, so that 10 bits hold each
//               component. Its RMS, between the values as well, is the computed noise's. But for these units
//               as much flows into each box between eight values as out of it.
//   gusts       the noise n, with the mean 0 and the computed noise's standard deviation, in half floats
const std::vector<float>& valuesOf(const NoiseTile& tile);

// Where in a tile a moment of curl noise, or a seed of gusts, is read: fractions of the tile in 2^-32.
glm::uvec3 tilePlace(uint32_t number);
// By how much of the tile's width a gust's pattern has moved across, in 2^-32, each time that the tile has
// passed: otherwise it would soon repeat.
constexpr uint32_t gustShift[] = {820338753u, 506806141u};
// The speed of a moment of curl noise, in lengths a period.
double momentDrift(int octaves);

}  // namespace shoal
