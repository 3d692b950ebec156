// A lane a slot: places, velocities and speeds in the order of the sorted keys, and where each key begins: key k has the slots
// starts[k] to starts[k + 1] - 1. No slot is given out by an atomic: the sort is stable, and the first body of a key
// writes the starts of all keys since the one before it.
layout(local_size_x = 64) in;

uniform int count;
uniform int keyCount;
uniform usamplerBuffer sorted;  // x key, y body
uniform samplerBuffer bodies;

layout(std430, binding = 0) writeonly buffer Starts { uint starts[]; };
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
    uint next = slot == 0 ? 0u : texelFetch(sorted, slot - 1).x + 1u;
    while (next <= pair.x) {
        starts[next] = uint(slot);
        ++next;
    }
    bool last = slot == count - 1;
    uint end = pair.x + 1u;
    while (last && end <= uint(keyCount)) {
        starts[end] = uint(count);
        ++end;
    }
}
