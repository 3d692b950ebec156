// Keys and bodies, to be sorted: for every entry of all grids, the key of the cell of its body, and the number of the body. The dead lie in
// no cell that is looked into: their place is far away.
#include "state/lanes.glsl"
#include "school/grid.glsl"
#pragma reads bodies
#ifdef TEXTURES
#pragma writes keys
#else
#pragma writes sorted
#endif

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
    int key = range.z + cellKey(cellOf(bodiesAt(body, 0).xyz, cellSizes[grid].x), range.w);
    return uvec2(uint(key), uint(body));
}

void main()
{
#ifdef TEXTURES
    int first = 2 * ownNumber();  // the sort leaves those behind the last alone
    newKeys = uvec4(pairOf(min(first, numbers - 1)), pairOf(min(first + 1, numbers - 1)));
#else
    int entry = ownLane();
    putSorted(entry, pairOf(entry));
#endif
}
