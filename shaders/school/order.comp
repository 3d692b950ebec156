// A lane a slot: places, velocities and speeds in the order of the sorted keys, and where each key begins.
#include "school/order.glsl"
#include "sort/starts.glsl"

layout(local_size_x = 64) in;

uniform int count;
uniform int keyCount;

layout(std430) writeonly buffer Places { vec4 places[]; };
layout(std430) writeonly buffer Velocities { vec4 velocities[]; };

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    uvec2 pair = texelFetch(sorted, slot).xy;
    places[slot] = placeOf(int(pair.y));
    velocities[slot] = velocityOf(int(pair.y));
    writeStarts(slot, pair.x, count, keyCount);
}
