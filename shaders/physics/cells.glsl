// The grid of contact: where a sphere lies, exactly, however far from the origin, and the key of its cell.
// Read as C++ through GLM by the tests.

// Local positions repeat every so many cells: they tell neighbours apart, and a float near 0 is fine.
const int localCells = 4;

struct CellPlace {
    ivec3 cell;
    vec3 local;  // m, in [0, localCells cells)
};

// position: relative to the anchor, m. `cell` has 5 significant bits: it is so many steps of the anchors' lattice, times a
// power of two, so the anchor's own cell and its place there follow in whole numbers, exactly. Quotients that are off by a
// rounding do no harm: what they leave over is in the rest. Numbers of cells wrap at 2^32.
CellPlace cellPlace(vec3 anchor, vec3 position, float cell)
{
    int bits = floatBitsToInt(cell);
    int doublings = min((bits >> 23) - 127, 26);
    int size = (16 + ((bits >> 19) & 15)) << max(doublings, 0);  // cell = size / finer lattice steps
    int finer = 1 << max(-doublings, 0);
    ivec3 point = ivec3(clamp(anchor * 16.0f, -1e9f, 1e9f));
    ivec3 whole = ivec3(floor(vec3(point) / float(size)));
    ivec3 part = (point - whole * size) * finer;
    ivec3 fine = ivec3(floor(vec3(part) / float(size)));
    ivec3 base = ivec3(uvec3(whole) * uint(finer)) + fine;
    vec3 rest = vec3(part - fine * size) * (0.0625f / float(finer)) + position;
    vec3 steps = floor(clamp(rest / cell, -1e9f, 1e9f));
    ivec3 index = base + ivec3(steps);
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
