// A lane an entry of one grid: the key of the cell of a body. The dead lie in no cell that is looked into: their place
// is far away.
#include "school/grid.glsl"

layout(local_size_x = 64) in;

uniform samplerBuffer bodies;
uniform int entries;
uniform int firstEntry;
uniform int firstBody;
uniform int firstKey;
uniform int keys;
uniform float inverseCell;

layout(std430, binding = 0) writeonly buffer Pairs { uvec2 pairs[]; };

void main()
{
    int entry = min(int(gl_GlobalInvocationID.x), entries - 1);
    vec4 place = texelFetch(bodies, 5 * (firstBody + entry));
    int key = firstKey + cellKey(cellOf(place.xyz, inverseCell), keys);
    pairs[firstEntry + entry] = uvec2(uint(key), uint(firstBody + entry));
}
