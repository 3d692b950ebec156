// effective: a texel a slot, contact/effective.glsl.
#include "contact/effective.glsl"
#ifdef WALLS
#include "contact/walls.glsl"
#endif

#ifdef TRIANGLES
layout(location = 0) out vec4 diagonal;  // contact/effective_sum.glsl
layout(location = 1) out vec4 beside;
#else
layout(location = 0) out uvec4 effectiveCount;
#endif

void main()
{
    int slot = ownNumber();
    int listed = slot < count ? min(int(fetch(counts, slot).x), LIST) : 0;
    if (listed == 0) discard;
    Sphere own = sphereAt(slot);
    NormalSum sum = normalsOf(slot, own, listed);
#ifdef WALLS
    vec4 wall = wallOf(slot);
    if (isNear(wall) && own.weight > 0.0) sum = withNormal(sum, wall.xyz);
#endif
#ifdef TRIANGLES
    diagonal = vec4(sum.diagonal, 0.0);
    beside = vec4(sum.beside, 0.0);
#else
    effectiveCount = uvec4(floatBitsToUint(largestEigenvalue(sum)), 0u, 0u, 0u);
#endif
}
