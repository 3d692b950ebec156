// The grid of contact: where a sphere lies, exactly, however far from the origin, and the key of its cell.
// Read as C++ through GLM by the tests.

// Local positions repeat every so many cells: they tell neighbours apart, and a float near 0 is fine.
const int localCells = 4;

struct CellPlace {
    ivec3 cell;
    vec3 local;  // m, in [0, localCells cells)
};

// position: relative to the anchor, m. `cell` has 5 significant bits, so that its multiples up to 2^19 are floats and
// the difference to an anchor close by is exact.
CellPlace cellPlace(vec3 anchor, vec3 position, float cell)
{
    vec3 base = floor(clamp(anchor / cell, -1e9f, 1e9f));
    vec3 rest = (anchor - base * cell) + position;
    vec3 steps = floor(clamp(rest / cell, -1e9f, 1e9f));
    ivec3 index = ivec3(base) + ivec3(steps);
    vec3 inCell = clamp(rest - steps * cell, 0.0f, cell);
    return CellPlace(index, inCell + vec3(index & (localCells - 1)) * cell);
}

// Returns a cell far from all others, for a sphere that is not there.
ivec3 cellApart(int sphere)
{
    return ivec3(0x40000000, sphere, 0);
}

// From local position b to a, when they are less than two cells apart along each axis.
vec3 localDifference(vec3 a, vec3 b, float cell)
{
    vec3 d = a - b;
    float period = float(localCells) * cell;
    return d - floor(d / period + 0.5f) * period;
}

// Cells of a block of 8 x 8 x 8 have keys that follow one another (modulo the table), so that what is close in space is
// mostly close in memory; blocks are scattered, so that the cells in use fill the table evenly whatever shape they have.
uint cellKey(ivec3 cell, uint mask)
{
    ivec3 block = cell >> 3;
    ivec3 inBlock = cell & 7;
    uint h = uint(block.x) * 3266489917u ^ uint(block.y) * 2654435769u ^ (uint(block.z) * 2246822507u + 374761393u);
    h = (h ^ (h >> 15u)) * 739982445u;
    h = (h ^ (h >> 12u)) * 695872825u;
    h = h ^ (h >> 15u);
    return (h + uint(inBlock.x + 8 * inBlock.y + 64 * inBlock.z)) & mask;
}

// The key of a sphere in a grid that is moved by half a cell, from its record: xyz of its cell, and its local position.
uint staggeredKey(ivec3 own, vec3 local, float cell, int keyMask)
{
    vec3 offset = local - vec3(own & (localCells - 1)) * cell;
    return cellKey(own + ivec3(step(vec3(0.5 * cell), offset)), uint(keyMask));
}
