// The key of a sphere in a grid that is moved by half a cell, from its record: xyz of its cell, and its local position.
uint staggeredKey(ivec3 own, vec3 local, float cell, int keyMask)
{
    vec3 offset = local - vec3(own & (localCells - 1)) * cell;
    return cellKey(own + ivec3(step(vec3(0.5 * cell), offset)), uint(keyMask));
}
