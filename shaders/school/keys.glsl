// What is sorted: for every entry of all grids, the key of the cell of its body, and the number of the body. The dead lie in
// no cell that is looked into: their place is far away.
#include "school/bodies.glsl"
#include "school/grid.glsl"

uniform ivec4 gridRanges[GRIDS];  // first entry, first body, first key, keys
uniform vec4 cellSizes[GRIDS];    // x 1 / cell, 1/m

uvec2 pairOf(int entry)
{
    int grid = 0;
    for (int g = 1; g < GRIDS; ++g) {
        if (entry >= gridRanges[g].x) grid = g;
    }
    ivec4 range = gridRanges[grid];
    int body = range.y + entry - range.x;
    int key = range.z + cellKey(cellOf(bodyElement(body, 0).xyz, cellSizes[grid].x), range.w);
    return uvec2(uint(key), uint(body));
}
