// How many spheres each cell of the table has, `keys` of them, while the grid is made; behind them, how many each tile of
// CELL_TILE cells has. Zero between two grids. Sums of whole numbers by atomics are exact in any order.
layout(std430) buffer CellCounts { uint cellCounts[]; };

uniform int keys;

// Where the count of a tile is: each in a line of a GPU's cache, since atomics on the same line wait for one another.
int placeOfTile(int tile)
{
    return keys + tile * LINE_WORDS;
}
