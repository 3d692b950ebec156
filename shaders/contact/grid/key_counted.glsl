// Which cell a sphere lies in, and how many spheres of the cell have come before it.
#include "contact/grid/cell_counts.glsl"
#pragma writes arrivals

void putKey(int sphere, ivec3 cell)
{
    if (isBehindLast()) return;
    uint key = cellKey(cell, uint(keys - 1));
    putArrivals(sphere, uvec2(key, atomicAdd(cellCounts[key], 1u)));
    atomicAdd(cellCounts[placeOfTile(int(key) / CELL_TILE)], 1u);
}
