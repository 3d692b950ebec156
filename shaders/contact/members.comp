// A lane a sphere: the spheres of each cell beside one another, within a cell in no particular order.
#include "contact/cell_counts.glsl"

layout(local_size_x = 64) in;

uniform usamplerBuffer arrivals;  // by sphere: x key, y how many spheres of the cell have come before
uniform usamplerBuffer starts;
uniform int count;

layout(std430) writeonly buffer Members { uint members[]; };

void main()
{
    int sphere = int(gl_GlobalInvocationID.x);
    if (sphere <= (keys - 1) / CELL_TILE) cellCounts[placeOfTile(sphere)] = 0u;
    if (sphere < count) {
        uvec2 arrival = texelFetch(arrivals, sphere).xy;
        members[texelFetch(starts, int(arrival.x)).x + arrival.y] = uint(sphere);
    }
}
