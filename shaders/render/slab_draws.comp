// Finds what of a sorted order lies in each slab of depth, and writes the draw of it: a lane a slab. A draw is 8 words:
// corners, instances, 0, 0, 0 (an indirect draw, with or without indices); the first place in the order; the first one
// past it; 0.
#include "render/order.glsl"

layout(local_size_x = LANES) in;

uniform usampler2D slabs;  // texel s: x the first key of slab s, y the first one past it
uniform int slabCount, moleculeCount, corners, batch;

layout(std430, binding = 0) writeonly buffer Draws { uint draws[]; };

void main()
{
    int s = int(gl_GlobalInvocationID.x);
    if (s >= slabCount) return;
    uvec2 bounds = texelFetch(slabs, ivec2(s, 0), 0).xy;
    int first = placeOf(bounds.x, moleculeCount), end = placeOf(bounds.y, moleculeCount);
    draws[8 * s] = uint(corners);
    draws[8 * s + 1] = uint((end - first + batch - 1) / batch);
    for (int word = 2; word < 8; ++word) draws[8 * s + word] = word == 5 ? uint(first) : word == 6 ? uint(end) : 0u;
}
