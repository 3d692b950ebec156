// The table of springs and triangles around each vertex (src/compile/plan.h).
uniform sampler2D topology;
uniform int topologyBase;  // of the group

vec4 table(int index)
{
    return texelFetch(topology, ivec2(index & 1023, index >> 10), 0);
}
