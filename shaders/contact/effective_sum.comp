// A lane a sphere of one group: contact/effective_sum.glsl.
#include "contact/shape.glsl"
#include "contact/effective_sum.glsl"

layout(std430, binding = 0) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };

void main()
{
    int lane = min(int(gl_GlobalInvocationID.x), partSpheres - 1);
    int molecule = lane / SPHERES;
    int moleculeSphere = firstSphere + molecule * SPHERES;
    int k = lane - molecule * SPHERES;
    effectiveCounts[int(fetch(slots, moleculeSphere + k).x)] = floatBitsToUint(effectiveSum(moleculeSphere, k));
}
