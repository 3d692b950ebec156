// A lane a slot: places, velocities and speeds in the order of the sorted keys, and where each key begins.
#include "sort/starts.glsl"

layout(local_size_x = 64) in;

uniform int count;
uniform int keyCount;
uniform samplerBuffer bodies;

layout(std430, binding = 1) writeonly buffer Places { vec4 places[]; };
layout(std430, binding = 2) writeonly buffer Velocities { vec4 velocities[]; };

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    uvec2 pair = texelFetch(sorted, slot).xy;
    int body = int(pair.y);
    vec4 place = texelFetch(bodies, 5 * body);
    places[slot] = place.w > 0.0 ? place : vec4(vec3(1e18), 0.0);
    vec3 velocity = texelFetch(bodies, 5 * body + 1).xyz;
    velocities[slot] = vec4(velocity, dot(velocity, texelFetch(bodies, 5 * body + 2).xyz));
    writeStarts(slot, pair.x, count, keyCount);
}
