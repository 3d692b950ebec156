// Types that the baseline's parts share: plain data, because the SIMD kernels are compiled for processors
// that the rest of the program need not have. An inline function with linkage in such a file could be the
// copy that the linker keeps for everyone; those files include this and nothing else of ours that holds code.
#pragma once

namespace shoal::bench {

// With the step's factors, and times what a force does to the velocity at the end of a substep.
struct KernelSpring {
    float stiffness, pull, damping;  // k, k L, c
};

// All that a kernel reads beside the state.
struct KernelStep {
    int substeps;
    float h;
    float decay, push[3];  // v += push - decay v, with push = wind decay + gravity phi
    float gravity[3];
    float normal[3], point[3], thickness, restitution, friction;  // of the plane

    int vertices, springs;
    const int* ends;                // 2 a spring
    const KernelSpring* constants;  // per spring
    const float* kick;              // per vertex, for `any`: 1/m over that of the first
};

// Advances blocks of `lanes` molecules by a frame. A block: per vertex the vectors x, y, z, vx, vy, vz of
// `lanes` floats, relative to the anchor; then the anchor's x, y, z. `scratch`: 3 vectors a vertex, for
// `any`. Everything is aligned to 64 bytes.
using Kernel = void (*)(float* blocks, int count, const KernelStep& step, float* scratch);

// Particles: an array for each component, aligned to 64 bytes, with room for whole vectors.
struct ParticleArrays {
    float *x, *y, *z, *vx, *vy, *vz, *age;
};

// A step of all of them (bench/particle_baseline.h).
struct ParticleKernelStep {
    float h, halfStep;
    float decay, push[3];                         // as above
    const float* heights;                         // null: nothing to fall on
    float columns, low[2], perMetre[2], last[2];  // last: of the samples' indices
    float highest;                                // m
    float restitution, kept;                      // kept: share of the velocity along the surface
};
using ParticleKernel = void (*)(const ParticleArrays& particles, int count, const ParticleKernelStep& step);

struct KernelSet {
    int lanes;
    Kernel quad, cross, fish, any;
    ParticleKernel particles;
};

// Null where the compiler does not have the instructions. Data, so that asking runs none of them.
extern const KernelSet* const avx2Kernels;
extern const KernelSet* const avx512Kernels;

}  // namespace shoal::bench
