// The particle loop of the CPU baseline for any width of vector V, as bench/baseline_simd.h says.
#pragma once

#include "bench/baseline_kernels.h"

namespace shoal::bench {

// Back onto the height field, where a particle is below it: bilinear heights, the normal from their slopes,
// reflected as in [Latta 2004, section 3.4.2, (4) and (5)].
template <class V>
SHOAL_INLINE void landParticles(V& x, V& y, V& z, V& vx, V& vy, V& vz, const ParticleKernelStep& step) {
    using Mask = typename V::Mask;
    const auto all = [](const float& value) SHOAL_BODY { return V::broadcast(&value); };
    if (!V::any(V::less(y, all(step.highest)))) return;
    const float none = 0, whole = 1;
    const V zero = all(none), one = all(whole);
    const V px = (x - all(step.low[0])) * all(step.perMetre[0]);
    const V pz = (z - all(step.low[1])) * all(step.perMetre[1]);
    const V cellX = V::floored(V::minimum(V::maximum(px, zero), all(step.last[0]) - one));
    const V cellZ = V::floored(V::minimum(V::maximum(pz, zero), all(step.last[1]) - one));
    const V fx = px - cellX, fz = pz - cellZ;
    const V at = V::fma(cellZ, all(step.columns), cellX), next = at + all(step.columns);
    const V near = V::gather(step.heights, at), right = V::gather(step.heights, at + one);
    const V far = V::gather(step.heights, next), across = V::gather(step.heights, next + one);
    const V nearRow = V::fma(right - near, fx, near), farRow = V::fma(across - far, fx, far);
    const V height = V::fma(farRow - nearRow, fz, nearRow);
    const V slopeX = V::fma((across - far) - (right - near), fz, right - near) * all(step.perMetre[0]);
    const V slopeZ = (farRow - nearRow) * all(step.perMetre[1]);
    const V squared = V::fma(slopeX, slopeX, V::fma(slopeZ, slopeZ, one));
    const V ny = V::inverseRoot(squared), nx = zero - slopeX * ny, nz = zero - slopeZ * ny;
    const V depth = (height - y) * ny;
    Mask below = V::both(V::less(zero, depth), V::both(V::less(zero, px), V::less(zero, pz)));
    below = V::both(below, V::both(V::less(px, all(step.last[0])), V::less(pz, all(step.last[1]))));
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

}  // namespace shoal::bench
