// The grid in which the members of a school find one another: its cells are as wide as the members see. Rows of cells
// along x are scattered over a table. The cells of a row follow one another in it and wrap around at its end, so the 27
// cells around a member are nine runs. A run may also hold members of other rows, which their places tell apart.

// Returns the cell of a place. inverseCell: 1 over a cell's width, 1/m.
ivec3 cellOf(vec3 place, float inverseCell)
{
    return ivec3(floor(clamp(place * inverseCell, -1e6, 1e6)));
}

int rowKey(ivec2 row)
{
    uint h = uint(row.x) * 2654435769u ^ (uint(row.y) * 3266489917u + 374761393u);
    h = (h ^ (h >> 15u)) * 739982445u;
    h = (h ^ (h >> 12u)) * 695872825u;
    return int((h ^ (h >> 15u)) & 0x3fffffffu);
}

// In [0, keys), which is a power of 2.
int cellKey(ivec3 cell, int keys)
{
    return (rowKey(cell.yz) + cell.x) & (keys - 1);
}
