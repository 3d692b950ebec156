// What the yardstick's parts share: plain data, because the SIMD kernels are compiled for processors that the
// rest of the program need not have. An inline function with linkage in such a file could be the copy that
// the linker keeps for everyone; those files include this and nothing else of ours that holds code.
#pragma once

namespace shoal::measure {

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

struct KernelSet {
    int lanes;
    Kernel quad, cross, fish, any;
};

// Null where the compiler does not have the instructions. Data, so that asking runs none of them.
extern const KernelSet* const avx2Kernels;
extern const KernelSet* const avx512Kernels;

}  // namespace shoal::measure
