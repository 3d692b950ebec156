// A lane a sphere of one group, or with RIGID a molecule: contact/effective_sum.glsl.
#include "contact/shape.glsl"
#include "contact/effective_sum.glsl"
#include "contact/resting.glsl"

layout(std430) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };

#ifdef RIGID
void main()
{
    int molecule = min(int(gl_GlobalInvocationID.x), partSpheres / SPHERES - 1);
    int first = firstSphere + molecule * SPHERES;
    bool isLeft = !rests(slotOf(first));
    while (isLeft) {
        float sum = effectiveSum(first);
        for (int k = 0; k < SPHERES; ++k) effectiveCounts[slotOf(first + k)] = floatBitsToUint(sum);
        isLeft = false;
    }
}
#else
void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int moleculeSphere = firstSphere + molecule * SPHERES;
    int k = lane - molecule * SPHERES;
    int slot = slotOf(moleculeSphere + k);
    bool isLeft = !rests(slot);
    while (isLeft) {
        effectiveCounts[slot] = floatBitsToUint(effectiveSum(moleculeSphere, k));
        isLeft = false;
    }
}
#endif
