// The particle loop that one writes for the CPU, vectorised and on all cores: what `shoal bench particles`
// compares with.
//
//   v += drag and gravity in a uniform wind, exactly;  x += h (v before + v) / 2;  height field;  age += h
//
// An array for each component. Every thread has a part of the particles of its own: what dies is replaced by
// the last of its part, what is born is appended to it, so that the living are always packed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "bench/baseline.h"
#include "scene/known_colliders.h"
#include "scene/placement.h"

namespace shoal::bench {

struct ParticleStep {
    double h = 1.0 / 60;  // s
    glm::dvec3 gravity{0}, wind{0};
    double drag = 0;  // 1/s
    const HeightFieldCollider* heights = nullptr;
    double restitution = 0.2,
           friction = 0.5;  // friction: share of the velocity along the surface that is lost
    // Births of a step, evenly over the threads, at random moments of it; none: none dies either.
    int births = 0;
    glm::dvec2 life{1};  // s, random between the two
    Box from;
    glm::dvec3 velocity{0};  // m/s, at birth
};

class ParticleBaseline {
  public:
    // `simd` must be available, capacity and threads at least 1.
    ParticleBaseline(size_t capacity, Simd simd, int threads);
    ~ParticleBaseline();
    ParticleBaseline(const ParticleBaseline&) = delete;
    ParticleBaseline& operator=(const ParticleBaseline&) = delete;

    // These live for ever; at most the capacity. m and m/s in world coordinates.
    void set(std::span<const glm::vec3> positions, std::span<const glm::vec3> velocities);
    void step(const ParticleStep& step);

    size_t count() const;
    struct Particle {
        glm::vec3 position, velocity;
        float age, life;  // s
    };
    std::vector<Particle> get() const;
    // Positions as they lie: x, y and z of each thread's part, to be uploaded.
    std::vector<std::span<const float>> positions() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace shoal::bench
