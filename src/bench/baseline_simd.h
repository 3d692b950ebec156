// The kernels of the baseline, for any width of vector. Included by one file per instruction set, which
// defines V (a vector of floats) without linkage, so that these templates have none either: see
// baseline_kernels.h.
//
// V has: lanes, Mask, operators + - *, and
//   broadcast(const float*), load(const float*), store(float*, V)
//   fma(a, b, c) = a b + c, fnma = c - a b, fms = a b - c
//   minimum, maximum, absolute, floored (nearest lower integer), inverse, inverseRoot
//   less(a, b) -> Mask, maskAnd, maskOr, maskNot(Mask), any(Mask), select(Mask, ifSo, ifNot)
//   gather(const float*, V): at whole numbers
//   leave(): what the processor wants before narrower code goes on
#pragma once

#include "bench/baseline_kernels.h"

#define SHOAL_BODY __attribute__((always_inline))  // of a lambda
#define SHOAL_INLINE SHOAL_BODY inline

namespace shoal::bench {

// ---- Compile-time loops

template <int I>
struct Index {
    static constexpr int value = I;
};

template <int I, int End, class Body>
SHOAL_INLINE void unrolled(const Body& body) {
    if constexpr (I < End) {
        body(Index<I>());
        unrolled<I + 1, End>(body);
    }
}

// ---- Vectors

template <class V>
struct V3 {
    V x, y, z;
};

template <class V>
SHOAL_INLINE V3<V> operator-(const V3<V>& a, const V3<V>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class V>
SHOAL_INLINE V dot(const V3<V>& a, const V3<V>& b) {
    return V::fma(a.z, b.z, V::fma(a.y, b.y, a.x * b.x));
}

// a + b s, a - b s
template <class V>
SHOAL_INLINE V3<V> plus(const V3<V>& a, const V3<V>& b, V s) {
    return {V::fma(b.x, s, a.x), V::fma(b.y, s, a.y), V::fma(b.z, s, a.z)};
}
template <class V>
SHOAL_INLINE V3<V> minus(const V3<V>& a, const V3<V>& b, V s) {
    return {V::fnma(b.x, s, a.x), V::fnma(b.y, s, a.y), V::fnma(b.z, s, a.z)};
}

template <class V>
SHOAL_INLINE V3<V> select(typename V::Mask mask, const V3<V>& a, const V3<V>& b) {
    return {V::select(mask, a.x, b.x), V::select(mask, a.y, b.y), V::select(mask, a.z, b.z)};
}

template <class V>
SHOAL_INLINE V3<V> broadcast3(const float* p) {
    return {V::broadcast(p), V::broadcast(p + 1), V::broadcast(p + 2)};
}
template <class V>
SHOAL_INLINE V3<V> load3(const float* p) {
    return {V::load(p), V::load(p + V::lanes), V::load(p + 2 * V::lanes)};
}
template <class V>
SHOAL_INLINE void store3(float* p, const V3<V>& a) {
    V::store(p, a.x);
    V::store(p + V::lanes, a.y);
    V::store(p + 2 * V::lanes, a.z);
}

// Hides that a pointer is the same every time: else every constant behind it is read before the loop and kept
// on the stack as a whole vector, which costs more than reading it again.
template <class T>
SHOAL_INLINE const T* afresh(const T* p) {
    asm volatile("" : "+r"(p));
    return p;
}

template <class V>
SHOAL_INLINE V constant(float value) {
    return V::broadcast(&value);
}

// ---- Physics, as in shaders/physics

// -(k (l - L) + c n.w) n for the difference d of the ends and w of their velocities, as a factor of d:
// ((k L - c d.w / l) / l) - k.
template <class V>
SHOAL_INLINE V springFactor(const V3<V>& d, const V3<V>& w, const KernelSpring& spring) {
    // Coincident ends: the addend makes the factor finite, and d is 0. Elsewhere it is lost in rounding.
    const V squared = V::fma(d.z, d.z, V::fma(d.y, d.y, V::fma(d.x, d.x, constant<V>(1e-24f))));
    const V inverse = V::inverseRoot(squared);
    const V pull = V::fnma(V::broadcast(&spring.damping) * dot(d, w), inverse, V::broadcast(&spring.pull));
    return V::fms(pull, inverse, V::broadcast(&spring.stiffness));
}

// The ground's part that a kernel keeps at hand; the rest is read when something touches it.
template <class V>
struct Ground {
    V3<V> normal;
    V offset;  // distance = x.n + offset
};

// v with exact drag and gravity.
template <class V>
SHOAL_INLINE V3<V> relaxed(const V3<V>& v, const KernelStep& step) {
    const V decay = V::broadcast(&step.decay);
    const V3<V> push = broadcast3<V>(step.push);
    return {v.x + V::fnma(decay, v.x, push.x), v.y + V::fnma(decay, v.y, push.y),
            v.z + V::fnma(decay, v.z, push.z)};
}

// shaders/physics/collide.glsl with drift = {h, h, h/2}, where `distance` is below 0. Few lanes ever bounce.
// before: the velocity that the substep began with.
template <class V>
SHOAL_INLINE void respond(V3<V>& x, V3<V>& v, const V3<V>& before, V distance, const KernelStep& step) {
    using Mask = typename V::Mask;
    const V zero = constant<V>(0), half = constant<V>(0.5f), tiny = constant<V>(1e-30f);
    const V h = V::broadcast(&step.h), friction = V::broadcast(&step.friction);
    const V3<V> n = broadcast3<V>(step.normal), gravity = broadcast3<V>(step.gravity);
    const V kickTime = V::fnma(h, V::broadcast(&step.decay), h);  // of the springs, at the substep's end
    const V3<V> acceleration = plus(gravity, v - relaxed(before, step), V::inverse(kickTime));
    const V depth = zero - distance, vn = dot(v, n), gn = dot(acceleration, n);
    const Mask below = V::less(distance, zero), inwards = V::maskAnd(below, V::less(vn, zero));

    const V synchronised = V::fma(gn * half, h, vn);
    const V energy = V::maximum(V::fma(synchronised, synchronised, (gn + gn) * depth), zero);
    const V restitution = V::broadcast(&step.restitution), least = half * V::absolute(gn) * h;
    Mask bounces = V::maskAnd(inwards, V::less(least * least, restitution * restitution * energy));
    V newNormal = zero, height = zero, frictionTime = h, normalChange = zero - vn;
    if (V::any(bounces)) {
        const V impact = energy * V::inverseRoot(V::maximum(energy, tiny));
        const V pace = V::maximum(half * (impact - synchronised), constant<V>(1e-20f));
        const V since = V::minimum(depth * V::inverse(pace), h);
        const V rebound = restitution * impact, leaving = V::fma(half * gn, since, rebound);
        bounces = V::maskAnd(bounces, V::less(zero, leaving));
        newNormal = V::select(bounces, V::fma(gn, since - half * h, rebound), newNormal);
        height = V::select(bounces, leaving * since, height);
        frictionTime = V::select(bounces, since, frictionTime);
        normalChange = V::select(bounces, rebound + impact, normalChange);
    }

    const V3<V> tangential = minus(v, n, vn);
    const V squared = dot(tangential, tangential);
    const V inverseSpeed = V::inverseRoot(V::maximum(squared, tiny));
    const V most = friction * normalChange, speed = squared * inverseSpeed;
    const V share = V::minimum(most * inverseSpeed, constant<V>(1));
    const V3<V> lost{tangential.x * share, tangential.y * share, tangential.z * share};
    const V started = V::fnma(vn, h, distance);
    const V slack = V::minimum(constant<V>(1e-6f), constant<V>(-0.02f) * vn * h);
    const Mask rests = V::maskAnd(V::maskNot(V::maskOr(bounces, V::less(most, speed))),
                                  V::less(V::absolute(started), slack));

    const V3<V> surface = plus(x, n, depth), still{zero, zero, zero};
    const V3<V> position = select(rests, minus(x, v, h), minus(plus(surface, n, height), lost, frictionTime));
    const V3<V> velocity = select(rests, still, plus(tangential - lost, n, newNormal));
    x = select(below, select(inwards, position, surface), x);
    v = select(inwards, velocity, v);
}

template <class V>
SHOAL_INLINE V distanceOf(const V3<V>& x, const Ground<V>& ground) {
    return V::fma(x.z, ground.normal.z,
                  V::fma(x.y, ground.normal.y, V::fma(x.x, ground.normal.x, ground.offset)));
}

// Anchors follow vertex 0 (shaders/physics/anchor.glsl). Returns the plane as this block sees it.
template <class V>
SHOAL_INLINE Ground<V> beginFrame(float* block, int vertices, const KernelStep& step) {
    float* const anchorAt = block + 6 * vertices * V::lanes;
    V3<V> anchor = load3<V>(anchorAt);
    const V3<V> first = load3<V>(block);
    const V far = V::maximum(V::absolute(first.x), V::maximum(V::absolute(first.y), V::absolute(first.z)));
    const typename V::Mask moves = V::less(constant<V>(1), far);
    if (__builtin_expect(V::any(moves), 0)) {
        const V zero = constant<V>(0), lattice = constant<V>(16), half = constant<V>(0.5f),
                unit = constant<V>(0.0625f);
        const V3<V> shift{V::select(moves, V::floored(V::fma(first.x, lattice, half)) * unit, zero),
                          V::select(moves, V::floored(V::fma(first.y, lattice, half)) * unit, zero),
                          V::select(moves, V::floored(V::fma(first.z, lattice, half)) * unit, zero)};
        anchor = {anchor.x + shift.x, anchor.y + shift.y, anchor.z + shift.z};
        store3(anchorAt, anchor);
        for (int i = 0; i < vertices; ++i) {
            float* const p = block + 6 * i * V::lanes;
            store3(p, load3<V>(p) - shift);
        }
    }
    const V3<V> normal = broadcast3<V>(step.normal);
    return {normal, dot(anchor - broadcast3<V>(step.point), normal) - V::broadcast(&step.thickness)};
}

// ---- Kernels

// Springs first to last - 1 change the velocities in `next`.
template <class V, class Topology, int first, int last>
SHOAL_INLINE void pullAll(const V3<V>* x, const V3<V>* v, V3<V>* next, const KernelSpring* constants) {
    unrolled<first, last>([&](auto s) SHOAL_BODY {
        constexpr int a = Topology::ends[s.value].a, b = Topology::ends[s.value].b;
        const V3<V> d = x[a] - x[b];
        const V factor = springFactor(d, v[a] - v[b], constants[s.value]);
        next[a] = plus(next[a], d, factor);
        next[b] = minus(next[b], d, factor);
    });
}

// The molecule stays in registers, as far as they go, from the first substep to the last.
template <class V, class Topology>
void runInRegisters(float* blocks, int count, const KernelStep& step, float*) {
    constexpr int vertices = Topology::vertices;
    for (int b = 0; b < count; ++b, blocks += (6 * vertices + 3) * V::lanes) {
        const Ground<V> ground = beginFrame<V>(blocks, vertices, step);
        V3<V> x[vertices], v[vertices];
        unrolled<0, vertices>([&](auto i) SHOAL_BODY {
            x[i.value] = load3<V>(blocks + 6 * i.value * V::lanes);
            v[i.value] = load3<V>(blocks + (6 * i.value + 3) * V::lanes);
        });
        for (int substep = 0; substep < step.substeps; ++substep) {
            V3<V> next[vertices];
            unrolled<0, vertices>([&](auto i) SHOAL_BODY { next[i.value] = relaxed(v[i.value], step); });
            pullAll<V, Topology, 0, Topology::springs>(x, v, next, afresh(step.constants));
            V lowest = constant<V>(1);
            unrolled<0, vertices>([&](auto i) SHOAL_BODY {
                x[i.value] = plus(x[i.value], next[i.value], V::broadcast(&step.h));
                lowest = V::minimum(lowest, distanceOf(x[i.value], ground));
            });
            if (V::any(V::less(lowest, constant<V>(0)))) {
                unrolled<0, vertices>([&](auto i) SHOAL_BODY {
                    const V distance = distanceOf(x[i.value], ground);
                    if (vertices <= 4 || V::any(V::less(distance, constant<V>(0))))
                        respond(x[i.value], next[i.value], v[i.value], distance, step);
                });
            }
            unrolled<0, vertices>([&](auto i) SHOAL_BODY { v[i.value] = next[i.value]; });
        }
        unrolled<0, vertices>([&](auto i) SHOAL_BODY {
            store3(blocks + 6 * i.value * V::lanes, x[i.value]);
            store3(blocks + (6 * i.value + 3) * V::lanes, v[i.value]);
        });
    }
    V::leave();
}

// Larger ones: the state stays in a core's first cache, and the springs are unrolled as far as they repeat,
// so that their code stays in the core's caches as well.
template <class V, class Topology>
void runInCache(float* blocks, int count, const KernelStep& step, float*) {
    constexpr int vertices = Topology::vertices;
    for (int b = 0; b < count; ++b, blocks += (6 * vertices + 3) * V::lanes) {
        const Ground<V> ground = beginFrame<V>(blocks, vertices, step);
        V3<V> x[vertices], v[vertices], next[vertices];
        for (int i = 0; i < vertices; ++i) {
            x[i] = load3<V>(blocks + 6 * i * V::lanes);
            v[i] = load3<V>(blocks + (6 * i + 3) * V::lanes);
        }
        for (int substep = 0; substep < step.substeps; ++substep) {
            for (int i = 0; i < vertices; ++i)
                next[i] = relaxed(v[i], step);
            for (int r = 0; r < Topology::repeats; ++r) {
                const int first = r * Topology::shift;
                pullAll<V, Topology, 0, Topology::period>(x + first, v + first, next + first,
                                                          afresh(step.constants + r * Topology::period));
            }
            pullAll<V, Topology, Topology::repeats * Topology::period, Topology::springs>(
                x, v, next, afresh(step.constants));
            for (int i = 0; i < vertices; ++i) {
                x[i] = plus(x[i], next[i], V::broadcast(&step.h));
                const V distance = distanceOf(x[i], ground);
                if (V::any(V::less(distance, constant<V>(0)))) respond(x[i], next[i], v[i], distance, step);
                v[i] = next[i];
            }
        }
        for (int i = 0; i < vertices; ++i) {
            store3(blocks + 6 * i * V::lanes, x[i]);
            store3(blocks + (6 * i + 3) * V::lanes, v[i]);
        }
    }
    V::leave();
}

// Any molecule: the state stays in the block, which a core's first cache holds.
template <class V>
void runAny(float* blocks, int count, const KernelStep& step, float* next) {
    const int size = (6 * step.vertices + 3) * V::lanes;
    for (int b = 0; b < count; ++b, blocks += size) {
        const Ground<V> ground = beginFrame<V>(blocks, step.vertices, step);
        for (int substep = 0; substep < step.substeps; ++substep) {
            for (int i = 0; i < step.vertices; ++i) {
                const V3<V> v = load3<V>(blocks + (6 * i + 3) * V::lanes);
                store3(next + 3 * i * V::lanes, relaxed(v, step));
            }
            for (int s = 0; s < step.springs; ++s) {
                const int i = step.ends[2 * s], j = step.ends[2 * s + 1];
                const float* const first = blocks + 6 * i * V::lanes;
                const float* const other = blocks + 6 * j * V::lanes;
                const V3<V> d = load3<V>(first) - load3<V>(other);
                const V3<V> w = load3<V>(first + 3 * V::lanes) - load3<V>(other + 3 * V::lanes);
                const V factor = springFactor(d, w, step.constants[s]);
                float *const nextOne = next + 3 * i * V::lanes, *const nextOther = next + 3 * j * V::lanes;
                store3(nextOne, plus(load3<V>(nextOne), d, V::broadcast(&step.kick[i]) * factor));
                store3(nextOther, minus(load3<V>(nextOther), d, V::broadcast(&step.kick[j]) * factor));
            }
            for (int i = 0; i < step.vertices; ++i) {
                float* const p = blocks + 6 * i * V::lanes;
                V3<V> v = load3<V>(next + 3 * i * V::lanes);
                V3<V> x = plus(load3<V>(p), v, V::broadcast(&step.h));
                const V distance = distanceOf(x, ground);
                if (V::any(V::less(distance, constant<V>(0))))
                    respond(x, v, load3<V>(p + 3 * V::lanes), distance, step);
                store3(p, x);
                store3(p + 3 * V::lanes, v);
            }
        }
    }
    V::leave();
}

// ---- Particles

// Back onto the height field, where a particle is below it: bilinear heights, the normal from their slopes,
// reflected as in [Latta 2004, section 3.4.2, (4) and (5)].
template <class V>
SHOAL_INLINE void landParticles(V& x, V& y, V& z, V& vx, V& vy, V& vz, const ParticleKernelStep& step) {
    using Mask = typename V::Mask;
    const auto all = [](const float& value) SHOAL_BODY { return V::broadcast(&value); };
    if (!V::any(V::less(y, all(step.highest)))) return;
    const float none = 0, whole = 1;
    const V zero = all(none), unit = all(whole);
    const V px = (x - all(step.low[0])) * all(step.perMetre[0]);
    const V pz = (z - all(step.low[1])) * all(step.perMetre[1]);
    const V cellX = V::floored(V::minimum(V::maximum(px, zero), all(step.last[0]) - unit));
    const V cellZ = V::floored(V::minimum(V::maximum(pz, zero), all(step.last[1]) - unit));
    const V fx = px - cellX, fz = pz - cellZ;
    const V index = V::fma(cellZ, all(step.columns), cellX), next = index + all(step.columns);
    const V near = V::gather(step.heights, index), right = V::gather(step.heights, index + unit);
    const V far = V::gather(step.heights, next), across = V::gather(step.heights, next + unit);
    const V nearRow = V::fma(right - near, fx, near), farRow = V::fma(across - far, fx, far);
    const V height = V::fma(farRow - nearRow, fz, nearRow);
    const V slopeX = V::fma((across - far) - (right - near), fz, right - near) * all(step.perMetre[0]);
    const V slopeZ = (farRow - nearRow) * all(step.perMetre[1]);
    const V squared = V::fma(slopeX, slopeX, V::fma(slopeZ, slopeZ, unit));
    const V ny = V::inverseRoot(squared), nx = zero - slopeX * ny, nz = zero - slopeZ * ny;
    const V depth = (height - y) * ny;
    Mask below = V::maskAnd(V::less(zero, depth), V::maskAnd(V::less(zero, px), V::less(zero, pz)));
    below = V::maskAnd(below, V::maskAnd(V::less(px, all(step.last[0])), V::less(pz, all(step.last[1]))));
    if (!V::any(below)) return;
    const V vn = V::fma(vx, nx, V::fma(vy, ny, vz * nz));
    const V back = zero - V::minimum(vn, zero) * all(step.restitution) + V::maximum(vn, zero);
    const V kept = all(step.kept);
    x = V::select(below, V::fma(nx, depth, x), x);
    y = V::select(below, V::fma(ny, depth, y), y);
    z = V::select(below, V::fma(nz, depth, z), z);
    vx = V::select(below, V::fma(nx, back, (vx - nx * vn) * kept), vx);
    vy = V::select(below, V::fma(ny, back, (vy - ny * vn) * kept), vy);
    vz = V::select(below, V::fma(nz, back, (vz - nz * vn) * kept), vz);
}

// leapfrog (shaders/solver/leapfrog.glsl) without springs.
template <class V>
void moveParticles(const ParticleArrays& p, int count, const ParticleKernelStep& step) {
    const V h = V::broadcast(&step.h), half = V::broadcast(&step.halfStep), decay = V::broadcast(&step.decay);
    const V pushX = V::broadcast(step.push), pushY = V::broadcast(step.push + 1),
            pushZ = V::broadcast(step.push + 2);
    for (int i = 0; i < count; i += V::lanes) {
        const V oldX = V::load(p.vx + i), oldY = V::load(p.vy + i), oldZ = V::load(p.vz + i);
        V vx = oldX + V::fnma(decay, oldX, pushX), vy = oldY + V::fnma(decay, oldY, pushY),
          vz = oldZ + V::fnma(decay, oldZ, pushZ);
        V x = V::fma(oldX + vx, half, V::load(p.x + i)), y = V::fma(oldY + vy, half, V::load(p.y + i)),
          z = V::fma(oldZ + vz, half, V::load(p.z + i));
        if (step.heights) landParticles(x, y, z, vx, vy, vz, step);
        V::store(p.x + i, x);
        V::store(p.y + i, y);
        V::store(p.z + i, z);
        V::store(p.vx + i, vx);
        V::store(p.vy + i, vy);
        V::store(p.vz + i, vz);
        if (p.age) V::store(p.age + i, V::load(p.age + i) + h);
    }
    V::leave();
}

template <class V>
constexpr KernelSet kernelsOf() {
    return {V::lanes,  runInRegisters<V, Quad>, runInRegisters<V, Cross>, runInCache<V, Fish>,
            runAny<V>, moveParticles<V>};
}

}  // namespace shoal::bench
