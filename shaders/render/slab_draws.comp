// Finds what of a sorted order lies in each slab of depth, and writes the draw of it: a lane a slab. A draw is 8 words:
// corners, instances, first, 0, 0 (an indirect draw, with or without indices); the first place in the order; the first one
// past it; 0.
#include "render/order.glsl"

layout(local_size_x = LANES) in;

uniform usampler2D slabs;  // texel s: x the first key of slab s, y the first one past it
uniform int slabCount, moleculeCount;
uniform ivec4 streams[STREAMS];  // x corners, y the first index, z molecules an instance; one for all slabs or one each

layout(std430) writeonly buffer Draws { uint draws[]; };

void main()
{
    int s = int(gl_GlobalInvocationID.x);
    if (s >= slabCount) return;
    uvec2 bounds = texelFetch(slabs, ivec2(s, 0), 0).xy;
    int first = placeOf(bounds.x, moleculeCount), end = placeOf(bounds.y, moleculeCount);
    ivec4 stream = streams[min(s, STREAMS - 1)];
    draws[8 * s] = uint(stream.x);
    draws[8 * s + 1] = uint((end - first + stream.z - 1) / stream.z);
    draws[8 * s + 2] = uint(stream.y);
    for (int word = 3; word < 8; ++word) draws[8 * s + word] = word == 5 ? uint(first) : word == 6 ? uint(end) : 0u;
}
