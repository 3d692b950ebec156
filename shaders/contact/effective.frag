// effective: a texel a slot, contact/effective.glsl.
#include "contact/effective.glsl"

layout(location = 0) out uvec4 effectiveCount;

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? min(int(fetch(counts, slot).x), LIST) : 0;
    if (listed == 0) discard;
    NormalSum sum = normalsOf(slot, sphereAt(slot), listed);
    effectiveCount = uvec4(floatBitsToUint(largestEigenvalue(sum)), 0u, 0u, 0u);
}
