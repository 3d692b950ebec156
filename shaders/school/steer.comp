// A lane one of a school, in the order of its grid, so that neighbouring lanes look into the same cells.
#include "state/packed.glsl"
#include "school/steer.glsl"

layout(local_size_x = 64) in;

uniform usamplerBuffer sorted;

layout(std430) buffer Steering { vec4 steering[]; };

void main()
{
    // A lane overwrites what it has read, so no two lanes may steer the same member.
    if (int(gl_GlobalInvocationID.x) >= grids[0].y) return;
    int slot = grids[0].x + int(gl_GlobalInvocationID.x);
    int body = int(texelFetch(sorted, slot).y);
    int first = firstElement(body - firstBody, STEERING_ELEMENTS);
    vec4 steered[STEERING_ELEMENTS];
    steer(body, slot, steering[first + 2 * BLOCK], steered);
    for (int e = 0; e < STEERING_ELEMENTS; ++e) steering[first + e * BLOCK] = steered[e];
}
