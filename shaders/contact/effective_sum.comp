// A lane a sphere of one group: contact/effective_sum.glsl.
#include "contact/shape.glsl"
#include "contact/effective_sum.glsl"
#ifdef RESTING
#include "contact/resting.glsl"
#endif

layout(std430, binding = 0) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int moleculeSphere = firstSphere + molecule * SPHERES;
    int k = lane - molecule * SPHERES;
    int slot = int(fetch(slots, moleculeSphere + k).x);
    bool takesPart = true;
#ifdef RESTING
    takesPart = !rests(slot);
#endif
    while (takesPart) {
        effectiveCounts[slot] = floatBitsToUint(effectiveSum(moleculeSphere, k));
        takesPart = false;
    }
}
