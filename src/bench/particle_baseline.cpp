#include "bench/particle_baseline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/baseline_simd.h"
#include "bench/baseline_threads.h"
#include "core/contract.h"

namespace shoal::bench {

using glm::vec3;

namespace {

// Vectors of one, for processors without.
struct V1 {
    static constexpr int lanes = 1;
    using Mask = bool;
    float v;

    friend V1 operator+(V1 a, V1 b) { return {a.v + b.v}; }
    friend V1 operator-(V1 a, V1 b) { return {a.v - b.v}; }
    friend V1 operator*(V1 a, V1 b) { return {a.v * b.v}; }
    static V1 broadcast(const float* p) { return {*p}; }
    static V1 load(const float* p) { return {*p}; }
    static void store(float* p, V1 a) { *p = a.v; }
    static V1 fma(V1 a, V1 b, V1 c) { return {a.v * b.v + c.v}; }
    static V1 fnma(V1 a, V1 b, V1 c) { return {c.v - a.v * b.v}; }
    static V1 minimum(V1 a, V1 b) { return {std::min(a.v, b.v)}; }
    static V1 maximum(V1 a, V1 b) { return {std::max(a.v, b.v)}; }
    static V1 floored(V1 a) { return {std::floor(a.v)}; }
    static V1 inverseRoot(V1 a) { return {1 / std::sqrt(a.v)}; }
    static bool less(V1 a, V1 b) { return a.v < b.v; }
    static bool maskAnd(bool a, bool b) { return a && b; }
    static bool any(bool a) { return a; }
    static V1 select(bool mask, V1 a, V1 b) { return mask ? a : b; }
    static V1 gather(const float* p, V1 indices) { return {p[size_t(indices.v)]}; }
    static void leave() {}
};

// A thread's own, in cache lines of its own.
struct alignas(64) Part {
    enum Component { x, y, z, vx, vy, vz, age, life, components };
    Part(size_t room_, uint32_t seed)
        : room(room_), stride((room_ + 15) / 16 * 16), random(seed), data(components * stride) {}

    float* array(int component) const { return data.data() + size_t(component) * stride; }
    float uniform() {  // in [0, 1), xorshift [Marsaglia 2003]
        random ^= random << 13;
        random ^= random >> 17;
        random ^= random << 5;
        return float(random >> 8) * 0x1p-24f;
    }
    void letDie() {
        const float *ages = array(age), *lives = array(life);
        for (size_t i = 0; i < count;) {
            if (ages[i] < lives[i]) {
                ++i;
                continue;
            }
            --count;
            for (int c = 0; c < components; ++c)
                array(c)[i] = array(c)[count];
        }
    }
    void spawn(int births, const ParticleStep& step) {
        const vec3 low(step.from.low), size(step.from.high - step.from.low), velocity(step.velocity);
        const auto shortest = float(step.life.x), range = float(step.life.y - step.life.x);
        for (int n = 0; n < births && count < room; ++n, ++count) {
            const float since = uniform() * float(step.h);
            for (int k = 0; k < 3; ++k) {
                array(x + k)[count] = low[k] + size[k] * uniform() + velocity[k] * since;
                array(vx + k)[count] = velocity[k];
            }
            array(age)[count] = since;
            array(life)[count] = shortest + range * uniform();
        }
    }

    size_t room, stride, count = 0;
    uint32_t random;
    AlignedFloats data;
};

ParticleKernelStep kernelStep(const ParticleStep& step) {
    ParticleKernelStep out{};
    out.h = float(step.h);
    out.halfStep = float(step.h / 2);
    const double decay = -std::expm1(-step.drag * step.h), phi = step.drag > 0 ? decay / step.drag : step.h;
    out.decay = float(decay);
    for (int k = 0; k < 3; ++k)
        out.push[k] = float(step.wind[k] * decay + step.gravity[k] * phi);
    if (!step.heights) return out;
    const HeightFieldCollider& field = *step.heights;
    out.heights = field.heights.data();
    out.columns = float(field.columns);
    const glm::dvec2 last(field.columns - 1, field.rows - 1);
    for (int k = 0; k < 2; ++k) {
        out.low[k] = float(field.low[k]);
        out.last[k] = float(last[k]);
        out.perMetre[k] = float(last[k] / (field.high[k] - field.low[k]));
    }
    out.highest = *std::max_element(field.heights.begin(), field.heights.end());
    out.restitution = float(step.restitution);
    out.kept = float(1 - step.friction);
    return out;
}

}  // namespace

struct ParticleBaseline::Data {
    Data(size_t capacity, Simd simd, int count) : threads(count) {
        if (simd == Simd::scalar) kernel = moveParticles<V1>;
        if (simd == Simd::avx2) kernel = avx2Kernels->particles;
        if (simd == Simd::avx512) kernel = avx512Kernels->particles;
        for (int i = 0; i < count; ++i) {
            const auto [first, last] = threads.part(capacity, i);
            parts.emplace_back(last - first, 2463534242u + uint32_t(i));
        }
    }
    PinnedThreads threads;
    ParticleKernel kernel = nullptr;
    std::vector<Part> parts;
};

ParticleBaseline::ParticleBaseline(size_t capacity, Simd simd, int threads) {
    EXPECTS(available(simd) && capacity > 0 && threads > 0);
    data_ = std::make_unique<Data>(capacity, simd, threads);
}

ParticleBaseline::~ParticleBaseline() = default;

void ParticleBaseline::set(std::span<const vec3> positions, std::span<const vec3> velocities) {
    EXPECTS(positions.size() == velocities.size());
    size_t next = 0;
    for (Part& part : data_->parts) {
        part.count = std::min(part.room, positions.size() - next);
        for (size_t i = 0; i < part.count; ++i, ++next) {
            for (int k = 0; k < 3; ++k) {
                part.array(Part::x + k)[i] = positions[next][k];
                part.array(Part::vx + k)[i] = velocities[next][k];
            }
            part.array(Part::age)[i] = 0;
            part.array(Part::life)[i] = std::numeric_limits<float>::infinity();
        }
    }
    EXPECTS(next == positions.size());
}

void ParticleBaseline::step(const ParticleStep& step) {
    Data& d = *data_;
    const ParticleKernelStep constants = kernelStep(step);
    d.threads.run([&](int index) {
        Part& part = d.parts[size_t(index)];
        float* const ages = step.births > 0 ? part.array(Part::age) : nullptr;
        d.kernel({part.array(Part::x), part.array(Part::y), part.array(Part::z), part.array(Part::vx),
                  part.array(Part::vy), part.array(Part::vz), ages},
                 int(part.count), constants);
        if (step.births == 0) return;
        part.letDie();
        const auto [first, last] = d.threads.part(size_t(step.births), index);
        part.spawn(int(last - first), step);
    });
}

size_t ParticleBaseline::count() const {
    size_t out = 0;
    for (const Part& part : data_->parts)
        out += part.count;
    return out;
}

std::vector<ParticleBaseline::Particle> ParticleBaseline::get() const {
    std::vector<Particle> out;
    for (const Part& part : data_->parts) {
        const auto value = [&](int component, size_t i) { return part.array(component)[i]; };
        for (size_t i = 0; i < part.count; ++i)
            out.push_back({vec3(value(Part::x, i), value(Part::y, i), value(Part::z, i)),
                           vec3(value(Part::vx, i), value(Part::vy, i), value(Part::vz, i)),
                           value(Part::age, i), value(Part::life, i)});
    }
    return out;
}

std::vector<std::span<const float>> ParticleBaseline::positions() const {
    std::vector<std::span<const float>> out;
    for (const Part& part : data_->parts)
        for (const int component : {Part::x, Part::y, Part::z})
            out.emplace_back(part.array(component), part.count);
    return out;
}

}  // namespace shoal::bench
