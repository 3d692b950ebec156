// The key of the cell of a sphere, to be sorted; in fragments contact/grid/keys.pass.glsl makes it.
#pragma writes sorted when buffers

uniform int keys;  // of the table of cells

void putKey(int sphere, ivec3 cell)
{
    putSorted(sphere, uvec2(cellKey(cell, uint(keys - 1)), uint(sphere)));
}
