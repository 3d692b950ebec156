// Random numbers that are the same on every machine: PCG [O'Neill 2014].
// The standard library's distributions are not used: their results differ between implementations.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace shoal {

// PCG-XSH-RR 64/32: 64 bits of state, 32 bits out. Streams with different numbers are independent.
class Random {
  public:
    explicit Random(uint64_t seed, uint64_t stream = 0) : increment_((stream << 1) | 1) {
        next();
        state_ += seed;
        next();
    }

    uint32_t next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment_;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }

    // Uniform in [0, 1), with all 53 bits of a double.
    double uniform() {
        const uint64_t high = next() >> 5, low = next() >> 6;
        return static_cast<double>((high << 26) | low) / 9007199254740992.0;
    }
    // Uniform in [from, to).
    double uniform(double from, double to) { return from + (to - from) * uniform(); }

    // Uniform on the unit sphere: height and longitude are independent (Archimedes).
    glm::dvec3 direction() {
        const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi);
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

// PCG-RXS-M-XS 32, the same bits as hashSeed in shaders/physics/random.glsl.
inline uint32_t hash(uint32_t seed, uint32_t counter) {
    const uint32_t state = (seed ^ (counter * 2654435769u)) * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}
// Uniform in [0, 1), as uniformFrom in that file.
inline double uniformFrom(uint32_t bits) {
    return double(bits >> 8) / 16777216.0;
}
inline uint32_t hash(uint32_t value) {
    return hash(value, 0);
}
template <std::convertible_to<uint32_t>... More>
uint32_t hash(uint32_t first, uint32_t second, uint32_t third, More... more) {
    return hash(hash(first, second), third, static_cast<uint32_t>(more)...);
}

}  // namespace shoal
