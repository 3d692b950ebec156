// A step of counting cells. First a workgroup has a tile of CELL_TILE cells: where each cell begins in the order of the keys, starts[key] to
// starts[key + 1] - 1, by adding up how many spheres the cells before it have. Leaves the cells' counts at zero. Then, with MEMBERS, a lane
// has a sphere: the spheres of each cell beside one another, within a cell in no particular order.
#include "contact/grid/cell_counts.glsl"
#ifdef MEMBERS
#include "state/lanes.glsl"
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
#else
#include "sort/group_scan.glsl"
#pragma writes starts

layout(local_size_x = LANES) in;

const int PER_LANE = CELL_TILE / LANES;

void main()
{
    int lane = int(gl_LocalInvocationID.x);
    int tile = int(gl_WorkGroupID.x);
    uint own = 0u;
    for (int t = lane; t < tile; t += LANES) own += cellCounts[placeOfTile(t)];
    uint before;
    sumBefore(own, before);
    int first = tile * CELL_TILE + lane * PER_LANE;
    int end = min(first + PER_LANE, keys);
    uint sum = 0u;
    for (int key = first; key < end; ++key) sum += cellCounts[key];
    uint total;
    uint start = before + sumBefore(sum, total);
    for (int key = first; key < end; ++key) {
        uint here = cellCounts[key];
        cellCounts[key] = 0u;
        putStarts(key, start);
        start += here;
    }
    if (end == keys) putStarts(keys, start);
}
#endif
