// A lane a slot in contact: contact/effective.glsl.
#include "contact/touching.glsl"
#include "contact/effective.glsl"

#ifdef TRIANGLES
layout(std430, binding = 0) writeonly buffer Normals { vec4 normals[]; };  // two a slot: contact/effective_sum.comp
#else
layout(std430, binding = 0) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };
#endif
#ifdef WALLS
#include "contact/walls.glsl"
#endif

void main()
{
    int taken = touchingSlot();
    int slot = max(taken, 0);
    Sphere own = sphereAt(slot);
    NormalSum sum = normalsOf(slot, own, taken < 0 ? 0 : min(int(texelFetch(counts, slot).x), LIST));
#ifdef WALLS
    vec4 wall = wallOf(slot);
    if (isNear(wall) && own.weight > 0.0) sum = withNormal(sum, wall.xyz);
#endif
    if (taken >= 0) {
#ifdef TRIANGLES
        normals[2 * slot] = vec4(sum.diagonal, 0.0);
        normals[2 * slot + 1] = vec4(sum.beside, 0.0);
#else
        effectiveCounts[slot] = floatBitsToUint(largestEigenvalue(sum));
#endif
    }
}
