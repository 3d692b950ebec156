// Numbers the molecules of a group and gives them their keys: pairs to be sorted.
#include "render/order_key.glsl"

layout(local_size_x = LANES) in;

layout(std430) writeonly buffer Pairs { uvec2 pairs[]; };  // x key, y molecule

void main()
{
    int molecule = int(gl_GlobalInvocationID.x);
    if (molecule >= moleculeCount) return;
    pairs[molecule] = uvec2(orderKey(molecule), uint(molecule));
}
