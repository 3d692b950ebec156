// The grid in which those of a school find one another: cells as wide as what they see. Rows of cells along x are
// scattered over a table, a row's cells follow one another in it, and past its end at its beginning: the 27 cells around
// one are nine runs. What other rows left in a run is told from its place.

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
