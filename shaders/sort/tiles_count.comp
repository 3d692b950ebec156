// Radix sort by tiles: counts the digits of each workgroup's tile. counts[digit * parts + tile]. Adding by atomics is
// exact in any order: nothing here depends on which lane came first.
#include "sort/digit.glsl"
#include "sort/wait.glsl"

layout(local_size_x = LANES) in;

uniform int count, parts;  // pairs; tiles

layout(std430) writeonly buffer Counts { uint counts[]; };
layout(std430) readonly buffer Pairs { uvec2 pairs[]; };  // x key, y index

shared uint own[LANES];  // at most as many digits

void main()
{
    int lane = int(gl_LocalInvocationID.x), tile = int(gl_WorkGroupID.x);
    own[lane] = 0u;
    waitForGroup();
    int end = min((tile + 1) * TILE_PAIRS, count);
    for (int i = tile * TILE_PAIRS + lane; i < end; i += LANES) atomicAdd(own[digitOf(pairs[i].x)], 1u);
    waitForGroup();
    if (lane < digits) counts[lane * parts + tile] = own[lane];
}
