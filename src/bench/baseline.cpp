#include "bench/baseline.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bench/baseline_kernels.h"
#include "bench/baseline_threads.h"
#include "compile/pack.h"
#include "core/contract.h"

namespace shoal::bench {

using glm::vec3;

namespace {

const KernelSet* kernelsOf(Simd simd) {
    return simd == Simd::avx512 ? avx512Kernels : simd == Simd::avx2 ? avx2Kernels : nullptr;
}

bool processorHas(Simd simd) {
#if defined(__x86_64__)
    if (simd == Simd::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (simd == Simd::avx512) {
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("fma");
    }
#endif
    return simd == Simd::scalar;
}

template <class Topology>
bool matches(const Molecule& molecule) {
    const auto weighsAsMuch = [&](const Vertex& v) { return v.mass == molecule.vertices[0].mass; };
    return molecule.vertices.size() == Topology::vertices &&
           std::all_of(molecule.vertices.begin(), molecule.vertices.end(), weighsAsMuch) &&
           std::equal(molecule.springs.begin(), molecule.springs.end(), std::begin(Topology::ends),
                      std::end(Topology::ends),
                      [](const Spring& s, const SpringEnds& e) { return s.a == e.a && s.b == e.b; });
}

Kernel kernelFor(const KernelSet& set, const Molecule& molecule) {
    if (matches<Quad>(molecule)) return set.quad;
    if (matches<Cross>(molecule)) return set.cross;
    if (matches<Fish>(molecule)) return set.fish;
    return set.any;
}

// ---- `scalar`: an array of vertices, loops over springs and vertices. What the compiler vectorises by
// itself with the project's own options it may.

struct ScalarVertex {
    vec3 position, velocity;
};

struct ScalarSpring {
    int a, b;
    float stiffness, damping, restLength;
};

struct ScalarMolecules {
    int vertexCount = 0;
    std::vector<ScalarSpring> springs;
    std::vector<float> inverseMass;      // 1/kg, per vertex
    std::vector<ScalarVertex> vertices;  // relative to the anchor, molecule by molecule
    std::vector<vec3> anchors;
};

vec3 springForce(const ScalarVertex& a, const ScalarVertex& b, const ScalarSpring& spring) {
    const vec3 d = a.position - b.position;
    const float squared = glm::dot(d, d);
    if (squared < 1e-24f) return vec3(0);
    const float inverse = 1 / std::sqrt(squared);
    const vec3 n = d * inverse;
    const float stretch = squared * inverse - spring.restLength;
    return n * -(spring.stiffness * stretch + spring.damping * glm::dot(n, a.velocity - b.velocity));
}

// shaders/physics/collide.glsl with euler's drift: step h, kickDrift h, lag h/2.
void respond(ScalarVertex& vertex, const vec3& acceleration, float distance, const BaselineStep& step) {
    vec3& x = vertex.position;
    vec3& v = vertex.velocity;
    const vec3 n = step.planeNormal;
    const float depth = -distance, vn = glm::dot(v, n);
    const vec3 surface = x + n * depth;
    if (vn >= 0) {
        x = surface;
        return;
    }
    const float gn = glm::dot(acceleration, n), lag = 0.5f * step.h;
    const float synchronised = vn + gn * lag;
    const float impact = std::sqrt(std::max(synchronised * synchronised + 2 * gn * depth, 0.0f));
    const float since = std::min(depth / std::max(0.5f * (impact - synchronised), 1e-20f), step.h);
    const float rebound = step.restitution * impact;
    const bool bounces = rebound > 0.5f * std::abs(gn) * step.h && rebound + 0.5f * gn * since > 0;
    const float newNormal = bounces ? rebound + gn * (since - lag) : 0;
    const float height = bounces ? (rebound + 0.5f * gn * since) * since : 0;
    const float frictionTime = bounces ? since : step.h;

    const vec3 tangential = v - n * vn;
    const float speed = std::sqrt(glm::dot(tangential, tangential));
    const float normalChange = bounces ? rebound + impact : -vn;
    const float lost = std::min(step.friction * normalChange, speed);
    const float started = distance - vn * step.h;
    const float slack = std::min(1e-6f, -0.02f * vn * step.h);
    if (!bounces && lost >= speed && std::abs(started) < slack) {
        x -= v * step.h;
        v = vec3(0);
        return;
    }
    const vec3 lostVelocity = speed > 0 ? tangential * (lost / speed) : vec3(0);
    x = surface + n * height - lostVelocity * frictionTime;
    v = tangential - lostVelocity + n * newNormal;
}

// shaders/physics/anchor.glsl
void moveAnchor(std::span<ScalarVertex> vertices, vec3& anchor) {
    const vec3 p = vertices[0].position;
    if (std::abs(p.x) <= 1 && std::abs(p.y) <= 1 && std::abs(p.z) <= 1) return;
    const vec3 shift = latticePoint(p);
    anchor += shift;
    for (ScalarVertex& vertex : vertices)
        vertex.position -= shift;
}

// Molecules first to last - 1. `force`: one entry a vertex, for the function's own use.
void frameScalar(ScalarMolecules& molecules, int first, int last, const BaselineStep& step,
                 std::span<vec3> force) {
    std::vector<ScalarSpring> springs = molecules.springs;
    for (ScalarSpring& spring : springs) {
        spring.stiffness *= step.stiffness;
        spring.damping *= step.damping;
    }
    const size_t count = size_t(molecules.vertexCount);
    for (int m = first; m < last; ++m) {
        const std::span<ScalarVertex> vertices(molecules.vertices.data() + size_t(m) * count, count);
        vec3& anchor = molecules.anchors[size_t(m)];
        moveAnchor(vertices, anchor);
        const float offset = glm::dot(anchor - step.planePoint, step.planeNormal) - step.thickness;
        for (int substep = 0; substep < step.substeps; ++substep) {
            std::fill(force.begin(), force.end(), vec3(0));
            for (const ScalarSpring& spring : springs) {
                const vec3 f = springForce(vertices[size_t(spring.a)], vertices[size_t(spring.b)], spring);
                force[size_t(spring.a)] += f;
                force[size_t(spring.b)] -= f;
            }
            for (size_t i = 0; i < count; ++i) {
                vec3& v = vertices[i].velocity;
                v += force[i] * (molecules.inverseMass[i] * step.h);
                v += (step.wind - v) * step.decay + step.gravity * step.phi;
                vertices[i].position += v * step.h;
                const float distance = glm::dot(vertices[i].position, step.planeNormal) + offset;
                if (distance < 0)
                    respond(vertices[i], step.gravity + force[i] * molecules.inverseMass[i], distance, step);
            }
        }
    }
}

}  // namespace

const char* name(Simd simd) {
    static constexpr const char* names[] = {"scalar", "avx2", "avx512"};
    return names[size_t(simd)];
}

bool available(Simd simd) {
    return processorHas(simd) && (simd == Simd::scalar || kernelsOf(simd) != nullptr);
}

Simd bestSimd() {
    Simd out = Simd::scalar;
    for (const Simd better : {Simd::avx2, Simd::avx512})
        if (available(better)) out = better;
    return out;
}

bool fitsBaseline(const Molecule& molecule) {
    return !molecule.vertices.empty() && !molecule.hasPins() &&
           std::none_of(molecule.springs.begin(), molecule.springs.end(),
                        [](const Spring& spring) { return spring.actuation.has_value(); });
}

struct Baseline::Data {
    Data(const Molecule& molecule, int count_, Simd simd, int threads_)
        : count(count_), vertexCount(int(molecule.vertices.size())), threads(threads_) {
        scalar.vertexCount = vertexCount;
        for (const Spring& spring : molecule.springs) {
            scalar.springs.push_back({spring.a, spring.b, float(spring.stiffness), float(spring.damping),
                                      float(molecule.restLength(spring))});
        }
        for (const Vertex& vertex : molecule.vertices)
            scalar.inverseMass.push_back(float(1 / vertex.mass));
        if (simd == Simd::scalar) {
            scalar.vertices.resize(size_t(count) * size_t(vertexCount));
            scalar.anchors.resize(size_t(count));
            force.resize(size_t(threads_), std::vector<vec3>(size_t(vertexCount)));
            return;
        }
        kernels = kernelsOf(simd);
        kernel = kernelFor(*kernels, molecule);
        blockCount = (count + kernels->lanes - 1) / kernels->lanes;
        blocks = AlignedFloats(size_t(blockCount) * blockFloats());
        for (int i = 0; i < threads_; ++i)
            scratch.emplace_back(size_t(3 * vertexCount * kernels->lanes));
        for (const ScalarSpring& spring : scalar.springs)
            ends.insert(ends.end(), {spring.a, spring.b});
    }

    size_t blockFloats() const { return size_t(6 * vertexCount + 3) * size_t(kernels->lanes); }
    // Returns component 0 to 5 of a vertex; 0 to 2 of "vertex" vertexCount is the anchor.
    float& value(int molecule, int vertex, int component) {
        if (!kernels) {
            if (vertex == vertexCount) return scalar.anchors[size_t(molecule)][component];
            ScalarVertex& state = scalar.vertices[size_t(molecule) * size_t(vertexCount) + size_t(vertex)];
            return component < 3 ? state.position[component] : state.velocity[component - 3];
        }
        const int lanes = kernels->lanes;
        return blocks.data()[size_t(molecule / lanes) * blockFloats() +
                             size_t((6 * vertex + component) * lanes + molecule % lanes)];
    }
    void frameInLanes(const BaselineStep& step);

    int count, vertexCount;
    PinnedThreads threads;

    ScalarMolecules scalar;  // its vertices only where there are no kernels
    std::vector<std::vector<vec3>> force;

    const KernelSet* kernels = nullptr;
    Kernel kernel = nullptr;
    int blockCount = 0;
    AlignedFloats blocks;
    std::vector<AlignedFloats> scratch;
    std::vector<int> ends;
};

Baseline::Baseline(const Molecule& molecule, int count, Simd simd, int threads) {
    EXPECTS(fitsBaseline(molecule) && count > 0 && threads > 0 && available(simd));
    data_ = std::make_unique<Data>(molecule, count, simd, threads);
}

Baseline::~Baseline() = default;
Baseline::Baseline(Baseline&&) noexcept = default;
Baseline& Baseline::operator=(Baseline&&) noexcept = default;

void Baseline::set(std::span<const vec3> positions, std::span<const vec3> velocities) {
    Data& d = *data_;
    EXPECTS(positions.size() == size_t(d.count) * size_t(d.vertexCount) &&
            velocities.size() == positions.size());
    const auto first = [&](int molecule) { return size_t(molecule) * size_t(d.vertexCount); };
    const int places = d.kernels ? d.blockCount * d.kernels->lanes : d.count;
    for (int place = 0; place < places; ++place) {
        const int m = std::min(place, d.count - 1);  // the last block is filled up with copies
        const vec3 anchor = latticePoint(positions[first(m)]);
        for (int i = 0; i < d.vertexCount; ++i) {
            for (int k = 0; k < 3; ++k) {
                d.value(place, i, k) = positions[first(m) + size_t(i)][k] - anchor[k];
                d.value(place, i, 3 + k) = velocities[first(m) + size_t(i)][k];
            }
        }
        for (int k = 0; k < 3; ++k)
            d.value(place, d.vertexCount, k) = anchor[k];
    }
}

void Baseline::get(std::vector<vec3>& positions, std::vector<vec3>& velocities) const {
    Data& d = *data_;
    positions.clear();
    velocities.clear();
    const int anchor = d.vertexCount;
    for (int m = 0; m < d.count; ++m) {
        for (int i = 0; i < d.vertexCount; ++i) {
            positions.push_back(vec3(d.value(m, anchor, 0), d.value(m, anchor, 1), d.value(m, anchor, 2)) +
                                vec3(d.value(m, i, 0), d.value(m, i, 1), d.value(m, i, 2)));
            velocities.emplace_back(d.value(m, i, 3), d.value(m, i, 4), d.value(m, i, 5));
        }
    }
}

void Baseline::Data::frameInLanes(const BaselineStep& step) {
    KernelStep out{};
    out.substeps = step.substeps;
    out.h = step.h;
    out.decay = step.decay;
    for (int k = 0; k < 3; ++k) {
        out.push[k] = step.wind[k] * step.decay + step.gravity[k] * step.phi;
        out.gravity[k] = step.gravity[k];
        out.normal[k] = step.planeNormal[k];
        out.point[k] = step.planePoint[k];
    }
    out.thickness = step.thickness;
    out.restitution = step.restitution;
    out.friction = step.friction;
    out.vertices = vertexCount;
    out.springs = int(scalar.springs.size());
    // what is left of a kick of h f / m after the drag, for the first vertex
    const float kick = step.h * (1 - step.decay) * scalar.inverseMass[0];
    std::vector<KernelSpring> constants;
    for (const ScalarSpring& spring : scalar.springs) {
        const float stiffness = kick * spring.stiffness * step.stiffness;
        constants.push_back({stiffness, stiffness * spring.restLength, kick * spring.damping * step.damping});
    }
    std::vector<float> shares;
    for (const float inverse : scalar.inverseMass)
        shares.push_back(inverse / scalar.inverseMass[0]);
    out.ends = ends.data();
    out.constants = constants.data();
    out.kick = shares.data();
    threads.run([&](int index) {
        const auto [first, last] = threads.part(size_t(blockCount), index);
        kernel(blocks.data() + first * blockFloats(), int(last - first), out, scratch[size_t(index)].data());
    });
}

void Baseline::frame(const BaselineStep& step) {
    Data& d = *data_;
    if (d.kernels) return d.frameInLanes(step);
    d.threads.run([&](int index) {
        const auto [first, last] = d.threads.part(size_t(d.count), index);
        frameScalar(d.scalar, int(first), int(last), step, d.force[size_t(index)]);
    });
}

bool Baseline::unrolled() const {
    return data_->kernels != nullptr && data_->kernel != data_->kernels->any;
}

size_t Baseline::bytesPerMolecule() const {
    return size_t(6 * data_->vertexCount + 3) * sizeof(float);
}

}  // namespace shoal::bench
