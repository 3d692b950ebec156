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

// The springs of the molecules that Shoal ships for measuring, in their files' order, for kernels that unroll
// them at compile time. Baseline compares them with the molecule that it is given.
struct SpringEnds {
    int a, b;
};

struct Quad {
    static constexpr int vertices = 4, springs = 6;
    static constexpr SpringEnds ends[springs] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
};

struct Cross {
    static constexpr int vertices = 12, springs = 30;
    static constexpr SpringEnds ends[springs] = {
        {0, 9}, {0, 3}, {3, 6}, {6, 9},  {0, 1},   {1, 2},  {2, 3}, {3, 4}, {4, 5},  {5, 6},
        {6, 7}, {7, 8}, {8, 9}, {9, 10}, {10, 11}, {0, 11}, {3, 9}, {0, 6}, {0, 2},  {1, 3},
        {3, 5}, {4, 6}, {6, 8}, {7, 9},  {9, 11},  {0, 10}, {2, 4}, {5, 7}, {8, 10}, {1, 11}};
};

// Five times a ring of four and its way to the next, then the last ring.
struct Fish {
    static constexpr int vertices = 24, springs = 96;
    static constexpr int period = 18, repeats = 5,
                         shift = 4;  // spring s + period is spring s, `shift` vertices on
    static constexpr SpringEnds ends[springs] = {
        {0, 1},   {0, 2},   {0, 4},   {0, 5},   {1, 4},   {1, 2},   {1, 3},   {1, 5},   {1, 6},   {2, 5},
        {2, 3},   {2, 6},   {2, 7},   {3, 6},   {0, 3},   {3, 7},   {3, 4},   {0, 7},   {4, 5},   {4, 6},
        {4, 8},   {4, 9},   {5, 8},   {5, 6},   {5, 7},   {5, 9},   {5, 10},  {6, 9},   {6, 7},   {6, 10},
        {6, 11},  {7, 10},  {4, 7},   {7, 11},  {7, 8},   {4, 11},  {8, 9},   {8, 10},  {8, 12},  {8, 13},
        {9, 12},  {9, 10},  {9, 11},  {9, 13},  {9, 14},  {10, 13}, {10, 11}, {10, 14}, {10, 15}, {11, 14},
        {8, 11},  {11, 15}, {11, 12}, {8, 15},  {12, 13}, {12, 14}, {12, 16}, {12, 17}, {13, 16}, {13, 14},
        {13, 15}, {13, 17}, {13, 18}, {14, 17}, {14, 15}, {14, 18}, {14, 19}, {15, 18}, {12, 15}, {15, 19},
        {15, 16}, {12, 19}, {16, 17}, {16, 18}, {16, 20}, {16, 21}, {17, 20}, {17, 18}, {17, 19}, {17, 21},
        {17, 22}, {18, 21}, {18, 19}, {18, 22}, {18, 23}, {19, 22}, {16, 19}, {19, 23}, {19, 20}, {16, 23},
        {20, 21}, {20, 22}, {21, 22}, {21, 23}, {22, 23}, {20, 23}};
};

template <class Topology>
consteval bool repeats() {
    for (int s = Topology::period; s < Topology::repeats * Topology::period; ++s) {
        const SpringEnds previous = Topology::ends[s - Topology::period], next = Topology::ends[s];
        if (next.a != previous.a + Topology::shift || next.b != previous.b + Topology::shift) return false;
    }
    return true;
}
static_assert(repeats<Fish>());

}  // namespace shoal::bench
