// The table of springs and triangles around each vertex (src/compile/plan.h).
// A kernel, all lanes of which read the same entry, has it in a buffer.
uniform int topologyBase;  // of the group
#ifdef ROWS
layout(std430) readonly buffer Topology { vec4 topology[]; };

vec4 table(int index)
{
    return topology[index];
}
#else
uniform sampler2D topology;

vec4 table(int index)
{
    return texelFetch(topology, ivec2(index & 1023, index >> 10), 0);
}
#endif
