// The spheres of each cell beside one another, within a cell in no particular order.
#include "state/lanes.glsl"
#include "contact/grid/cell_counts.glsl"
#pragma reads arrivals starts
#pragma writes members

void main()
{
    int sphere = int(gl_GlobalInvocationID.x);
    if (sphere <= (keys - 1) / CELL_TILE) cellCounts[placeOfTile(sphere)] = 0u;
    if (isBehindLast()) return;
    uvec2 arrival = arrivalsAt(sphere);
    putMembers(startsAt(int(arrival.x)) + arrival.y, uint(sphere));
}
