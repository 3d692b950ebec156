// The kernels of the yardstick, for any width of vector. Included by one file per instruction set, which
// defines V (a vector of floats) without linkage, so that these templates have none either: see
// yardstick_kernels.h.
//
// V has: lanes, Mask, operators + - *, and
//   broadcast(const float*), load(const float*), store(float*, V), fma(a, b, c) = a b + c, fnma = c - a b,
//   minimum, maximum, absolute, nearest lower integer floored, root, quotient, inverseRoot,
//   less(a, b) -> Mask, both, either, no(Mask), any(Mask), select(Mask, ifSo, ifNot)
#pragma once

#include "measure/yardstick_kernels.h"
#include "measure/yardstick_topologies.h"

#define SHOAL_BODY __attribute__((always_inline))  // of a lambda
#define SHOAL_INLINE SHOAL_BODY inline

namespace shoal::measure {

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

template <class V>
SHOAL_INLINE V constant(float value) {
    return V::broadcast(&value);
}

// ---- Physics, as in shaders/physics

// -(k (l - L) + c n.w) n for the difference d of the ends and w of their velocities, as a factor of d.
template <class V>
SHOAL_INLINE V springFactor(const V3<V>& d, const V3<V>& w, const KernelSpring& spring) {
    // coincident ends: the guard makes the factor finite, and d is 0
    const V inverse = V::inverseRoot(V::maximum(dot(d, d), constant<V>(1e-24f)));
    const V stretch =
        V::fma(V::broadcast(&spring.pull), inverse, constant<V>(0) - V::broadcast(&spring.stiffness));
    return V::fnma(V::broadcast(&spring.damping) * inverse, inverse * dot(d, w), stretch);
}

// The ground's part that a kernel keeps at hand; the rest is read when something touches it.
template <class V>
struct Ground {
    V3<V> normal;
    V offset;  // distance = x.n + offset
};

// shaders/physics/collide.glsl, for the lanes in `below`; drift = {h, h, h/2}.
template <class V>
SHOAL_INLINE void respond(V3<V>& x, V3<V>& v, V distance, const KernelStep& step) {
    using Mask = typename V::Mask;
    const V zero = constant<V>(0), half = constant<V>(0.5f), h = V::broadcast(&step.h);
    const V3<V> n = broadcast3<V>(step.normal), gravity = broadcast3<V>(step.gravity);
    const V depth = zero - distance, vn = dot(v, n);
    const V3<V> surface = plus(x, n, depth);

    const V gn = dot(gravity, n);
    const V synchronised = V::fma(gn * half, h, vn);
    const V impact = V::root(V::maximum(V::fma(synchronised, synchronised, (gn + gn) * depth), zero));
    const V since =
        V::minimum(V::quotient(depth, V::maximum(half * (impact - synchronised), constant<V>(1e-20f))), h);
    const V rebound = V::broadcast(&step.restitution) * impact;
    const V leaving = V::fma(half * gn, since, rebound);
    const Mask bounces = V::both(V::less(half * V::absolute(gn) * h, rebound), V::less(zero, leaving));
    const V newNormal = V::select(bounces, V::fma(gn, since - half * h, rebound), zero);
    const V height = V::select(bounces, leaving * since, zero);
    const V frictionTime = V::select(bounces, since, h);

    const V3<V> tangential = minus(v, n, vn);
    const V speed = V::root(dot(tangential, tangential));
    const V normalChange = V::select(bounces, rebound + impact, zero - vn);
    const V most = V::broadcast(&step.friction) * normalChange;
    const V lost = V::minimum(most, speed);
    const V started = V::fnma(vn, h, distance);
    const V slack = V::minimum(constant<V>(1e-6f), constant<V>(-0.02f) * vn * h);
    const Mask rests =
        V::both(V::no(V::either(bounces, V::less(most, speed))), V::less(V::absolute(started), slack));
    const V share = V::quotient(lost, V::maximum(speed, constant<V>(1e-30f)));
    const V3<V> still{zero, zero, zero};
    const V3<V> lostVelocity = plus(still, tangential, share);
    const V3<V> position =
        select(rests, minus(x, v, h), minus(plus(surface, n, height), lostVelocity, frictionTime));
    const V3<V> velocity = select(rests, still, plus(tangential - lostVelocity, n, newNormal));

    const Mask below = V::less(distance, zero), inwards = V::less(vn, zero);
    x = select(below, select(inwards, position, surface), x);
    v = select(V::both(below, inwards), velocity, v);
}

// v = exact drag and gravity; x += h v; contact.
template <class V>
SHOAL_INLINE void advance(V3<V>& x, V3<V>& v, const KernelStep& step, const Ground<V>& ground) {
    const V decay = V::broadcast(&step.decay);
    const V3<V> push = broadcast3<V>(step.push);
    v = {v.x + V::fnma(decay, v.x, push.x), v.y + V::fnma(decay, v.y, push.y),
         v.z + V::fnma(decay, v.z, push.z)};
    x = plus(x, v, V::broadcast(&step.h));
    const V distance = V::fma(x.z, ground.normal.z,
                              V::fma(x.y, ground.normal.y, V::fma(x.x, ground.normal.x, ground.offset)));
    if (__builtin_expect(V::any(V::less(distance, constant<V>(0))), 0)) respond(x, v, distance, step);
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

// The molecule stays in registers, as far as they go, from the first substep to the last.
template <class V, class Topology>
void runUnrolled(float* blocks, int count, const KernelStep& step, float*) {
    constexpr int vertices = Topology::vertices;
    for (int b = 0; b < count; ++b, blocks += (6 * vertices + 3) * V::lanes) {
        const Ground<V> ground = beginFrame<V>(blocks, vertices, step);
        V3<V> x[vertices], v[vertices];
        unrolled<0, vertices>([&](auto i) SHOAL_BODY {
            x[i.value] = load3<V>(blocks + 6 * i.value * V::lanes);
            v[i.value] = load3<V>(blocks + (6 * i.value + 3) * V::lanes);
        });
        for (int substep = 0; substep < step.substeps; ++substep) {
            V3<V> force[vertices];
            unrolled<0, vertices>([&](auto i) SHOAL_BODY {
                force[i.value] = {constant<V>(0), constant<V>(0), constant<V>(0)};
            });
            unrolled<0, Topology::springs>([&](auto s) SHOAL_BODY {
                constexpr int a = Topology::ends[s.value].a, b2 = Topology::ends[s.value].b;
                const V3<V> d = x[a] - x[b2];
                const V factor = springFactor(d, v[a] - v[b2], step.constants[s.value]);
                force[a] = plus(force[a], d, factor);
                force[b2] = minus(force[b2], d, factor);
            });
            unrolled<0, vertices>([&](auto i) SHOAL_BODY {
                v[i.value] = plus(v[i.value], force[i.value], V::broadcast(&step.kick[i.value]));
                advance(x[i.value], v[i.value], step, ground);
            });
        }
        unrolled<0, vertices>([&](auto i) SHOAL_BODY {
            store3(blocks + 6 * i.value * V::lanes, x[i.value]);
            store3(blocks + (6 * i.value + 3) * V::lanes, v[i.value]);
        });
    }
}

// Any molecule: the state stays in the block, which a core's first cache holds.
template <class V>
void runAny(float* blocks, int count, const KernelStep& step, float* force) {
    const int size = (6 * step.vertices + 3) * V::lanes;
    const V zero = constant<V>(0);
    for (int b = 0; b < count; ++b, blocks += size) {
        const Ground<V> ground = beginFrame<V>(blocks, step.vertices, step);
        for (int substep = 0; substep < step.substeps; ++substep) {
            for (int i = 0; i < step.vertices; ++i)
                store3(force + 3 * i * V::lanes, V3<V>{zero, zero, zero});
            for (int s = 0; s < step.springs; ++s) {
                const int i = step.ends[2 * s], j = step.ends[2 * s + 1];
                const float *const one = blocks + 6 * i * V::lanes, *const other = blocks + 6 * j * V::lanes;
                const V3<V> d = load3<V>(one) - load3<V>(other);
                const V3<V> w = load3<V>(one + 3 * V::lanes) - load3<V>(other + 3 * V::lanes);
                const V factor = springFactor(d, w, step.constants[s]);
                float *const forceOne = force + 3 * i * V::lanes, *const forceOther =
                                                                      force + 3 * j * V::lanes;
                store3(forceOne, plus(load3<V>(forceOne), d, factor));
                store3(forceOther, minus(load3<V>(forceOther), d, factor));
            }
            for (int i = 0; i < step.vertices; ++i) {
                float* const p = blocks + 6 * i * V::lanes;
                V3<V> x = load3<V>(p), v = load3<V>(p + 3 * V::lanes);
                v = plus(v, load3<V>(force + 3 * i * V::lanes), V::broadcast(&step.kick[i]));
                advance(x, v, step, ground);
                store3(p, x);
                store3(p + 3 * V::lanes, v);
            }
        }
    }
}

template <class V>
constexpr KernelSet kernelsOf() {
    return {V::lanes, runUnrolled<V, Quad>, runUnrolled<V, Cross>, runUnrolled<V, Fish>, runAny<V>};
}

}  // namespace shoal::measure
