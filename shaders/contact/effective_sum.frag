// effective: a texel a slot, of the spheres of one group: contact/effective_sum.glsl.
#include "contact/shape.glsl"
#include "contact/effective_sum.glsl"
#include "contact/own_sphere.glsl"

layout(location = 0) out uvec4 newEffectiveCount;

void main()
{
    int lane = ownSphere() - firstSphere;
    if (lane < 0 || lane >= partSpheres) discard;
    int molecule = lane / SPHERES;
    int first = firstSphere + molecule * SPHERES;
#ifdef RIGID
    float sum = effectiveSum(first);
#else
    float sum = effectiveSum(first, lane - molecule * SPHERES);
#endif
    newEffectiveCount = uvec4(floatBitsToUint(sum), 0u, 0u, 0u);
}
